/// \file
/// JPEG pictures and files to Image; cameras and photographers make them, Seeker never writes them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "common/core/image.hpp"
#include "common/core/result.hpp"

namespace seeker::image {

/// Any JPEG as 8 bits and 1 (grey pictures) or 3 channels. Errors: kCorrupt for what is no JPEG, or a damaged or
/// shortened one, kTooLarge beyond kMaxImageSide_px.
[[nodiscard]] Result<Image> decode_jpeg(std::span<const std::uint8_t> bytes);

/// A PNG or a JPEG, by its first bytes, for any name of the file. Errors: those of decode_png() or decode_jpeg()
/// with the file's name, kNotFound, kIo.
[[nodiscard]] Result<Image> read_picture(const std::filesystem::path& path);

}  // namespace seeker::image
