/// \file
/// Whole files in and out: reading with a limit, writing so that a reader never sees half a file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "common/core/result.hpp"

namespace seeker::image {

/// Larger picture files are refused before they are read.
inline constexpr std::size_t kMaxFileSize_bytes = std::size_t{256} << 20U;

/// All bytes of a regular file. Errors: kNotFound, kIo, kTooLarge.
[[nodiscard]] Result<std::vector<std::uint8_t>> read_file(const std::filesystem::path& path,
                                                          std::size_t limit_bytes = kMaxFileSize_bytes);

/// Writes to a temporary name in the same folder, syncs and renames: afterwards the old or the new file is there,
/// whole. The folder must exist. Error: kIo.
[[nodiscard]] Status write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);
[[nodiscard]] Status write_file(const std::filesystem::path& path, std::string_view text);

}  // namespace seeker::image
