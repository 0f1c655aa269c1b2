/// \file
/// Sentences about what the operating system refuses, for this folder.
#pragma once

#include <cstring>
#include <filesystem>
#include <string>

#include "common/core/result.hpp"

namespace seeker::files {

/// kIo: "cannot read PATH: cause"; `number` is of errno.
inline tl::unexpected<Error> cannot(const std::string& what, const std::filesystem::path& path, int number,
                                    const std::string& remedy = "") {
  return fail(Errc::kIo, "cannot " + what + " " + path.string() + ": " + std::strerror(number) + remedy);
}

inline tl::unexpected<Error> cannot_write(const std::filesystem::path& path, int number) {
  return cannot("write", path, number, "; check that the folder exists, is writable and has space");
}

}  // namespace seeker::files
