/// \file
/// Chunks of PNG files that libpng's simplified interface cannot write.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace seeker::image {

/// Type and data of a text chunk that names the program a picture was made by.
[[nodiscard]] std::string png_software_text(std::string_view software);

/// Puts that chunk behind the header of a PNG file. Latin-1 text, shorter than 80 characters.
void insert_png_software(std::vector<std::uint8_t>& png, std::string_view software);

}  // namespace seeker::image
