#include "io/packed.hpp"

#include <zlib.h>

#include <freestand/error.hpp>

namespace freestand::io {

std::string packed(std::span<const std::byte> values, std::size_t item_bytes) {
  const std::size_t items = values.size() / item_bytes;
  std::string shuffled(values.size(), '\0');
  for (std::size_t byte = 0; byte < item_bytes; ++byte)
    for (std::size_t item = 0; item < items; ++item)
      shuffled[byte * items + item] = static_cast<char>(values[item * item_bytes + byte]);
  uLongf size = compressBound(shuffled.size());
  std::string bytes(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(bytes.data()), &size, reinterpret_cast<const Bytef*>(shuffled.data()),
                shuffled.size(), packing_level) != Z_OK)
    throw Error("samples cannot be packed (zlib refuses them): report this", Exit::data);
  bytes.resize(size);
  return bytes;
}

}  // namespace freestand::io
