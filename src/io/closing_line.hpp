// The last line of a result file, behind HDF5's end of it: "freestand closed this file, crc32 of all before this line 0a1b2c3d".
//
// HDF5 leaves alone what follows its own end, and so do h5py, xarray and netCDF-4. What it reads it takes at its word: of a
// damaged file it crashes, loops, asks for gigabytes, or returns other numbers. So no reader of ours opens one before its last line
// has been held against the bytes. That tells damage and changes, not forgery: whoever writes the line anew is believed. The checksum is
// that of zlib, gzip and PNG, of 3e9 bytes a second.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace freestand::io {

// Is it to be held against the bytes, or has another process of this run done that? (Each would read the whole file.)
enum class Closing { check, checked };

std::string closing_line(std::string_view bytes);  // of a whole file

// Behind what the file at `aside` holds, which messages call `path`. Throws Error as file_error() makes it.
void append_closing_line(const std::filesystem::path& aside, const std::filesystem::path& path);

// Throws Error (Exit::data) where the file cannot be read, does not end with that line, or is not what it was when it was closed.
void check_closing_line(const std::filesystem::path& path);

}  // namespace freestand::io
