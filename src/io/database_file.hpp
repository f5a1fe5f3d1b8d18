// A database of fragility as files: one HDF5 file that holds all of it, and beside it the same as tables of numbers (csv) and
// words (json) under the same ids.
#pragma once

#include <filesystem>
#include <string>

#include "database/database.hpp"

namespace freestand::io {

inline constexpr const char* database_format = "freestand-catalogue/1";
inline constexpr const char* words_format = "freestand-words/1";

// Names of the files in the folder of a database.
inline constexpr const char* database_name = "database.h5";
inline constexpr const char* entries_csv_name = "entries.csv";
inline constexpr const char* curves_csv_name = "fragility.csv";
inline constexpr const char* points_csv_name = "points.csv";
inline constexpr const char* words_name = "words.json";

// By one process. Root attributes: format, name, revision, confidence; /classes, /families: their words. Tables, one dataset a column
// (database_columns.hpp), each with its unit and description: /entries/NAME [entry]; /curves/NAME [curve] and /curves/entry,
// the row of its entry; /points/NAME [point] and /points/curve, the row of its curve. /intensities and /demands: the words of
// the tables, with name, unit, symbol, summary (demands: binary too).
void write_database(const std::filesystem::path& path, const database::Database&);

// Throws Error (Exit::data) if it is no such file.
database::Database read_database(const std::filesystem::path& path);

// The tables as text. Numbers read back to the same bits, missing ones are empty.
std::string entries_csv(const database::Database&);  // id and the numbers of each entry
std::string curves_csv(const database::Database&);   // id and all of each curve but its points
std::string points_csv(const database::Database&);   // id, intensity, demand, capacity and all of each point
std::string words_json(const database::Database&);   // words of the tables, and of each entry under its id

}  // namespace freestand::io
