"""Prints src/fragility/estimated_null_table.hpp: quantiles of S and A^2 (Kolmogorov & Smirnov, Anderson & Darling) of normal samples whose mean
and deviation are estimated from the same samples, scaled as Stephens does (1974), by simulation. Ten minutes of a core.

    tabulate_estimated_null.py > src/fragility/estimated_null_table.hpp
"""

import numpy as np
from scipy.special import ndtr

SIZES = (5, 6, 7, 8, 10, 12, 15, 20, 27, 40, 60, 100, 200, 1000)
CHANCES = (0.9999, 0.999, 0.99, 0.975, 0.95, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.25, 0.2, 0.15, 0.1, 0.075, 0.05, 0.035, 0.025,
           0.015, 0.01, 0.005, 0.0025, 0.001, 0.0005, 0.00025, 0.0001)
REPEATS = 4_000_000


def statistics(n, rng, rows):
    z = np.sort(rng.standard_normal((rows, n)), axis=1)
    u = ndtr((z - z.mean(axis=1, keepdims=True)) / z.std(axis=1, keepdims=True))
    i = np.arange(1, n + 1)
    ks = np.maximum((i / n - u).max(axis=1), (u - (i - 1) / n).max(axis=1)) * (n**0.5 - 0.01 + 0.85 / n**0.5)
    ad = -n - ((2 * i - 1) * (np.log(u) + np.log1p(-u[:, ::-1]))).sum(axis=1) / n
    return ks, ad * (1 + 0.75 / n + 2.25 / n**2)


def quantiles(n):
    rng = np.random.Generator(np.random.PCG64([1974, n]))
    rows = 2_000_000 // n
    parts = [statistics(n, rng, rows) for _ in range(-(-REPEATS // rows))]
    return [np.quantile(np.concatenate(part), 1 - np.array(CHANCES)) for part in zip(*parts)]


def line(numbers, digits):
    return "{" + ", ".join(f"{x:.{digits}g}" for x in numbers) + "}"


tables = [quantiles(n) for n in SIZES]
print("""// Made by tests/fragility/tabulate_estimated_null.py: scaled quantiles that goodness.hpp explains, of %d samples for each n.
#pragma once

#include <array>

// clang-format off

namespace freestand::fragility::estimated_null {

inline constexpr std::array sizes{%s};
// Probability to exceed, for the columns.
inline constexpr std::array chances{%s};
using Quantiles = std::array<std::array<double, chances.size()>, sizes.size()>;
""" % (REPEATS, ", ".join(map(str, SIZES)), ", ".join(map(str, CHANCES))))
for name, which in (("ks", 0), ("ad", 1)):
    print(f"inline constexpr Quantiles {name}{{{{")
    for table in tables:
        print(f"    {line(table[which], 5)},")
    print("}};")
print("// clang-format on\n\n}  // namespace freestand::fragility::estimated_null")
