/// \file
/// PGM (P5, binary grey) files: the format of ROS maps.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "common/core/image.hpp"
#include "common/core/result.hpp"

namespace seeker::image {

/// P5 with comments and a largest value of 1 to 255, scaled to 0..255. Errors: kParse, kTooLarge, kCorrupt.
[[nodiscard]] Result<Image> decode_pgm(std::span<const std::uint8_t> bytes);
[[nodiscard]] Result<Image> read_pgm(const std::filesystem::path& path);

/// Grey images only; a colour image is converted. `comment_lines`: lines that begin with '#', for the header.
[[nodiscard]] std::vector<std::uint8_t> encode_pgm(const Image& image, const std::string& comment_lines = {});
[[nodiscard]] Status write_pgm(const std::filesystem::path& path, const Image& image,
                               const std::string& comment_lines = {});

/// Reads a .png or a .pgm, distinguished by their first bytes.
[[nodiscard]] Result<Image> read_image(const std::filesystem::path& path);

}  // namespace seeker::image
