/// \file
/// PNG files to and from Image.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "common/core/image.hpp"
#include "common/core/result.hpp"

namespace seeker::image {

/// Any PNG (grey, palette, colour, 1 to 16 bits) as 8 bits and 1 (grey files) or 3 channels; what is transparent is
/// laid on white. Errors: kCorrupt for what is no PNG or a damaged one, kTooLarge beyond kMaxImageSide_px.
[[nodiscard]] Result<Image> decode_png(std::span<const std::uint8_t> bytes);
/// decode_png() of a file; its errors name the file. Also kNotFound, kIo.
[[nodiscard]] Result<Image> read_png(const std::filesystem::path& path);

/// The image as the bytes of a PNG file; `software`, if not empty, is written into it as the program that made it (see
/// export_mark.hpp). Errors: kInvalidArgument for an image without pixels, kTooLarge beyond kMaxImageSide_px.
[[nodiscard]] Result<std::vector<std::uint8_t>> encode_png(const Image& image, std::string_view software = {});
/// Atomic (see files::write_file()). Errors: those of encode_png(), kIo.
[[nodiscard]] Status write_png(const std::filesystem::path& path, const Image& image, std::string_view software = {});

}  // namespace seeker::image
