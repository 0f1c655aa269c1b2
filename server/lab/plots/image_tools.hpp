/// \file
/// Arranges pictures on a sheet.
#pragma once

#include <string>
#include <vector>

#include "common/core/image.hpp"

namespace seeker::lab {

struct CaptionedImage {
  std::string caption;  ///< empty: no caption
  Image image;
};

/// Pictures row by row in `columns` columns on white, each with its caption above; grey pictures are converted to
/// colour.
[[nodiscard]] Image contact_sheet(const std::vector<CaptionedImage>& pictures, int columns);

}  // namespace seeker::lab
