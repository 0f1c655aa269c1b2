/// \file
/// A database file that a program keeps open in its state folder.
#pragma once

#include <filesystem>
#include <string>

#include "server/store/database.hpp"
#include "server/store/schema.hpp"

namespace seeker::store {

/// Opens or creates the file `name`; makes the folder. kIo; kBusy: another program has it open; kUnsupportedVersion:
/// written by a newer program, left as it is. kCorrupt: the damaged file was moved aside (the message says where to),
/// so that the next open starts afresh.
[[nodiscard]] Result<Database> open_state_file(const std::filesystem::path& folder, const std::string& name,
                                               const Schema& schema);

}  // namespace seeker::store
