/// \file
/// Files to and from the robot as verbs need them: with progress on a terminal, over cuts of the link.
#pragma once

#include <filesystem>
#include <string>

#include "client/cli/context.hpp"
#include "common/api/transfer.hpp"

namespace seeker::cli {

/// Sends a file and has the robot do with it what `end` says, whose hash is set here. Errors of the file here are those
/// of usage; kUnsupportedVersion, with `too_old` set: the robot takes no files in pieces.
[[nodiscard]] Result<api::UploadedFile> send_file(const Context& context, const std::filesystem::path& file,
                                                  api::UploadEnd end, bool& too_old);
/// Writes a file of the robot to `to`, whole or not at all. What has arrived before a cut stays beside it as
/// `TO.HASH.part`; the next call goes on there.
[[nodiscard]] Status fetch_file(const Context& context, api::FileKind kind, const std::string& name,
                                const std::filesystem::path& to);
/// Sends the large pictures of a mission's targets, and names them by their hash in the request that is returned. A
/// robot that takes none gets the request as it is.
[[nodiscard]] Result<api::MissionRequest> send_pictures(const Context& context, api::MissionRequest request);

}  // namespace seeker::cli
