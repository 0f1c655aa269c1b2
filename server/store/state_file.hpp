/// \file
/// A database file that a program keeps open in its state folder.
#pragma once

#include <filesystem>
#include <string>

#include "server/store/database.hpp"
#include "server/store/schema.hpp"

namespace seeker::store {

struct StateFile {
  Database database;
  std::string lost;  ///< what was in it and no longer is, as a sentence; empty: nothing
};

/// Opens or creates the file `name`, which sentences call `what`; makes the folder. A damaged file is moved aside and
/// an empty one begun. kIo; kCorrupt: it cannot be moved; kBusy: another program has it open; kUnsupportedVersion:
/// written by a newer program, left as it is.
[[nodiscard]] Result<StateFile> open_state_file(const std::filesystem::path& folder, const std::string& name,
                                                const std::string& what, const Schema& schema);

}  // namespace seeker::store
