// Values as HDF5's filters shuffle and deflate pack them, so that whoever has values can pack them, and one process writes them.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace freestand::io {

inline constexpr int packing_level = 1;  // of deflate: higher ones take several times as long, for a tenth less

// Items of so many bytes: first the first byte of each, then the second of each, and so on, then deflated.
std::string packed(std::span<const std::byte> values, std::size_t item_bytes);

}  // namespace freestand::io
