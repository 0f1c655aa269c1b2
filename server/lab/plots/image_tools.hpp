/// \file
/// Putting pictures together on a sheet.
#pragma once

#include <string>
#include <vector>

#include "common/core/image.hpp"

namespace seeker::lab {

struct CaptionedImage {
  std::string caption;  ///< empty: none
  Image image;
};

/// Pictures row by row in `columns` columns on white, each with its caption above; grey ones become colour.
[[nodiscard]] Image contact_sheet(const std::vector<CaptionedImage>& pictures, int columns);

}  // namespace seeker::lab
