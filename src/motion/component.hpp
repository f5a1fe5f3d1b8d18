// Which way a record of one component points: a vertical one must not shake the floor sideways.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace freestand::motion {

// Up, UP, -UP, DWN, UD, U-D, V, Vert, HNZ ...: words that agencies write for vertical components, whatever the case.
bool is_vertical_word(std::string_view word);
// DWN, Down, DN at the beginning: positive downwards.
bool is_downward_word(std::string_view word);

// What tells that the record is vertical: "its header says so", or "its name ends in UP" where the header says nothing of
// it; empty where nothing tells. A file that cannot be read, or holds several channels, tells nothing here.
std::string vertical_sign(const std::filesystem::path&);

// Is a record of one channel, taken as vertical, positive downwards? By its header, or by its name where the header gives no direction.
bool points_down(const std::filesystem::path&);

}  // namespace freestand::motion
