// Real Fourier transforms by FFTW, as values.
#pragma once

#include <fftw3.h>

#include <complex>
#include <cstddef>
#include <memory>
#include <vector>

namespace freestand::motion {

// Smallest power of two that is not below n.
std::size_t transform_size(std::size_t n);

// Transforms of one size, planned once. Plans are estimated, never measured, and arrays are FFTW's own: the same input
// gives the same bits.
class RealTransform {
 public:
  using Spectrum = std::vector<std::complex<double>>;

  explicit RealTransform(std::size_t n);

  std::size_t size() const { return n_; }

  // sum_j x_j exp(-2 pi i j k / n), k = 0 ... n/2; x padded with zeros to n.
  Spectrum forward(const std::vector<double>& x) const;

  // The inverse of it, n real values (divided by n).
  std::vector<double> inverse(const Spectrum& spectrum) const;

 private:
  struct Free {
    void operator()(void* memory) const { fftw_free(memory); }
  };
  struct Destroy {
    void operator()(fftw_plan plan) const { fftw_destroy_plan(plan); }
  };
  using Plan = std::unique_ptr<std::remove_pointer_t<fftw_plan>, Destroy>;

  std::size_t n_;
  std::unique_ptr<double, Free> real_;
  std::unique_ptr<fftw_complex, Free> bins_;
  Plan forward_, inverse_;
};

}  // namespace freestand::motion
