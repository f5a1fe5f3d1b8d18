// What `query` says: tables for people, JSON for programs.
#pragma once

#include <string>
#include <vector>

#include "database/query.hpp"

namespace freestand::app {

// What is in a database: classes with their ranges, or the entries one by one where they are of one class; words; and what can be asked.
// folder: as the user named it.
std::string contents(const database::Database&, const std::string& folder);
std::string contents_json(const database::Database&);

// A question that this database answers, as a command line.
std::string example(const database::Database&, const std::string& folder);

std::string answers_text(const database::Database&, const database::Question&, const std::vector<database::Answer>&);
std::string answers_json(const database::Database&, const database::Question&, const std::vector<database::Answer>&);

}  // namespace freestand::app
