// Real Fourier transforms by FFTW, as values.
#pragma once

#include <complex>
#include <cstddef>
#include <vector>

namespace freestand::motion {

// Smallest power of two that is not below n.
std::size_t transform_size(std::size_t n);

// sum_j x_j exp(-2 pi i j k / n), k = 0 ... n/2; x padded with zeros to n.
std::vector<std::complex<double>> transform(const std::vector<double>& x, std::size_t n);

// The inverse of it, n real values (divided by n).
std::vector<double> inverse_transform(const std::vector<std::complex<double>>& spectrum, std::size_t n);

}  // namespace freestand::motion
