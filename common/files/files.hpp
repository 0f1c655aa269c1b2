/// \file
/// Whole files in and out. A file that is written is either whole or as it was: written under a temporary name, synced,
/// renamed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "common/core/result.hpp"

namespace seeker::files {

/// Larger files are refused before they are read, where the reader names no limit of its own.
inline constexpr std::size_t kMaxFileSize_bytes = std::size_t{256} << 20U;

/// All bytes of a regular file. kNotFound: none there; kTooLarge: longer than `limit_bytes`; kIo.
[[nodiscard]] Result<std::vector<std::uint8_t>> read_file(const std::filesystem::path& path,
                                                          std::size_t limit_bytes = kMaxFileSize_bytes);

/// What a file that was written outlives.
enum class Outlives : std::uint8_t {
  kPowerCut,
  kItsProgram,  ///< no wait for the disk, which may be busy for seconds; after a power cut it may be old, empty or gone
};

/// Who may read a file that was written; the owner may write it, too.
enum class ReadableBy : std::uint8_t {
  kAll,
  kOwner,  ///< for private keys, from the first byte on
};

/// Replaces or creates `path` with `bytes`. The temporary file lies beside it and is removed on failure; `path` then
/// still has its old content. kIo: full disk, no permission, no such folder.
[[nodiscard]] Status write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes,
                                Outlives outlives = Outlives::kPowerCut, ReadableBy readers = ReadableBy::kAll);
[[nodiscard]] Status write_file(const std::filesystem::path& path, std::string_view text,
                                ReadableBy readers = ReadableBy::kAll);

/// Makes a rename or a new file in `folder` survive a power cut.
[[nodiscard]] Status sync_folder(const std::filesystem::path& folder);

/// Makes the folder and those above it, where they are absent, so that they survive a power cut. kIo.
[[nodiscard]] Status make_folder(const std::filesystem::path& folder);

}  // namespace seeker::files
