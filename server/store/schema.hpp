/// \file
/// The tables of the state file, and the way from an older version to this one.
#pragma once

#include "server/store/database.hpp"

namespace seeker::store {

/// Marks a file as ours: "SEEK" in the database's header.
inline constexpr std::int64_t kApplicationId = 0x5345454B;

/// Checks the file and brings its tables to kSchemaVersion. kCorrupt: the structure is damaged; kUnsupportedVersion:
/// written by a newer program; kInvalidArgument: a database of another program. In these cases nothing was changed.
[[nodiscard]] Status prepare_schema(Database& database);

}  // namespace seeker::store
