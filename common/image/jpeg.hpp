/// \file
/// JPEG pictures to Image and back; cameras and photographers make them, and the emulated camera does.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "common/core/image.hpp"
#include "common/core/result.hpp"

namespace seeker::image {

/// Any JPEG as 8 bits and 1 (grey pictures) or 3 channels. Errors: kCorrupt for what is no JPEG, or a damaged or
/// shortened one, kTooLarge beyond kMaxImageSide_px.
[[nodiscard]] Result<Image> decode_jpeg(std::span<const std::uint8_t> bytes);

/// The picture as a JPEG of that quality, 1 (small) to 100 (near the original).
[[nodiscard]] std::vector<std::uint8_t> encode_jpeg(const Image& image, int quality);

/// A PNG or a JPEG, by its first bytes, for any name of the file. Errors: those of decode_png() or decode_jpeg()
/// with the file's name, kNotFound, kIo.
[[nodiscard]] Result<Image> read_picture(const std::filesystem::path& path);

}  // namespace seeker::image
