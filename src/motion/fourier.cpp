#include "motion/fourier.hpp"

#include <algorithm>

namespace freestand::motion {

std::size_t transform_size(std::size_t n) {
  std::size_t size = 1;
  while (size < n) size *= 2;
  return size;
}

RealTransform::RealTransform(std::size_t n)
    : n_(n),
      real_(fftw_alloc_real(n)),
      bins_(fftw_alloc_complex(n / 2 + 1)),
      forward_(fftw_plan_dft_r2c_1d(static_cast<int>(n), real_.get(), bins_.get(), FFTW_ESTIMATE)),
      inverse_(fftw_plan_dft_c2r_1d(static_cast<int>(n), bins_.get(), real_.get(), FFTW_ESTIMATE)) {}

RealTransform::Spectrum RealTransform::forward(const std::vector<double>& x) const {
  std::fill_n(real_.get(), n_, 0.0);
  std::copy_n(x.begin(), std::min(n_, x.size()), real_.get());
  fftw_execute(forward_.get());
  Spectrum spectrum;
  spectrum.reserve(n_ / 2 + 1);
  for (std::size_t k = 0; k < n_ / 2 + 1; ++k) spectrum.emplace_back(bins_.get()[k][0], bins_.get()[k][1]);
  return spectrum;
}

std::vector<double> RealTransform::inverse(const Spectrum& spectrum) const {
  for (std::size_t k = 0; k < n_ / 2 + 1; ++k) {
    bins_.get()[k][0] = spectrum[k].real();
    bins_.get()[k][1] = spectrum[k].imag();
  }
  fftw_execute(inverse_.get());
  std::vector<double> x(real_.get(), real_.get() + n_);
  for (double& value : x) value /= static_cast<double>(n_);
  return x;
}

}  // namespace freestand::motion
