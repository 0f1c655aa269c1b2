/// \file
/// Small files with a checksum, for state that a program must restore after it was cut off. Little-endian:
///
///   "SEEKRREC"  u32 version  u16 length and text of the kind  u32 bytes of the content  content  u32 CRC-32 of all
///   before
///
/// The writer defines the content; the kind identifies its format.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/result.hpp"
#include "common/files/files.hpp"

namespace seeker::store {

inline constexpr std::uint32_t kSealedFileVersion = 1;

[[nodiscard]] std::vector<std::uint8_t> seal(const std::string& kind, std::span<const std::uint8_t> content);
/// Returns the content of a sealed file. kParse: no sealed file, or one of another kind; kCorrupt: cut or altered;
/// kUnsupportedVersion: made by a newer program, with both versions in the message.
[[nodiscard]] Result<std::vector<std::uint8_t>> unseal(const std::string& kind, std::span<const std::uint8_t> bytes);

/// Replaces `path` as a whole or leaves it as it was; makes its folder. kIo.
[[nodiscard]] Status write_sealed_file(const std::filesystem::path& path, const std::string& kind,
                                       std::string_view content, files::Outlives outlives = files::Outlives::kPowerCut);
/// Errors of unseal() with the path in front; kNotFound, kTooLarge, kIo.
[[nodiscard]] Result<std::vector<std::uint8_t>> read_sealed_file(const std::filesystem::path& path,
                                                                 const std::string& kind, std::size_t limit_bytes);

}  // namespace seeker::store
