/// \file
/// The tables of a database file, and the check that a file has them.
#pragma once

#include "server/store/database.hpp"

namespace seeker::store {

/// The schema of the files of one kind.
struct Schema {
  const char* tables;           ///< SQL that makes them in an empty file
  std::int64_t application_id;  ///< marks a file as being of this kind, in the database's header
  std::int64_t version;         ///< written by this program; a newer file is refused
  const char* check;            ///< SQL that says "ok" where the structure is whole
};

/// The schema of the state file, whose application id is "SEEK".
[[nodiscard]] const Schema& state_schema();

/// Checks the file; an empty one gets the tables. kCorrupt: the structure is damaged; kUnsupportedVersion: written by a
/// newer program; kInvalidArgument: a database of another kind. In these cases nothing was changed.
[[nodiscard]] Status prepare_schema(Database& database, const Schema& schema = state_schema());

}  // namespace seeker::store
