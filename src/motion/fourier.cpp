#include "motion/fourier.hpp"

#include <fftw3.h>

#include <algorithm>
#include <memory>

namespace freestand::motion {
namespace {

// Plans are estimated, never measured, and arrays are FFTW's own: the same input gives the same bits.
struct Work {
  explicit Work(std::size_t n)
      : real(fftw_alloc_real(n), fftw_free),
        bins(fftw_alloc_complex(n / 2 + 1), fftw_free),
        size(static_cast<int>(n)) {}
  std::unique_ptr<double, decltype(&fftw_free)> real;
  std::unique_ptr<fftw_complex, decltype(&fftw_free)> bins;
  int size;
};

void run(fftw_plan plan) {
  fftw_execute(plan);
  fftw_destroy_plan(plan);
}

}  // namespace

std::size_t transform_size(std::size_t n) {
  std::size_t size = 1;
  while (size < n) size *= 2;
  return size;
}

std::vector<std::complex<double>> transform(const std::vector<double>& x, std::size_t n) {
  Work work(n);
  const fftw_plan plan = fftw_plan_dft_r2c_1d(work.size, work.real.get(), work.bins.get(), FFTW_ESTIMATE);
  std::fill_n(work.real.get(), n, 0.0);
  std::copy_n(x.begin(), std::min(n, x.size()), work.real.get());
  run(plan);
  std::vector<std::complex<double>> spectrum(n / 2 + 1);
  for (std::size_t k = 0; k < spectrum.size(); ++k) spectrum[k] = {work.bins.get()[k][0], work.bins.get()[k][1]};
  return spectrum;
}

std::vector<double> inverse_transform(const std::vector<std::complex<double>>& spectrum, std::size_t n) {
  Work work(n);
  const fftw_plan plan = fftw_plan_dft_c2r_1d(work.size, work.bins.get(), work.real.get(), FFTW_ESTIMATE);
  for (std::size_t k = 0; k < n / 2 + 1; ++k) {
    work.bins.get()[k][0] = spectrum[k].real();
    work.bins.get()[k][1] = spectrum[k].imag();
  }
  run(plan);
  std::vector<double> x(work.real.get(), work.real.get() + n);
  for (double& value : x) value /= static_cast<double>(n);
  return x;
}

}  // namespace freestand::motion
