#include "server/lab/plots/image_tools.hpp"

#include <algorithm>

#include "common/image/canvas.hpp"

namespace seeker::lab {
namespace {

constexpr int kGap_px = 10;
constexpr int kCaption_px = 24;
constexpr double kCaptionText_px = 10.5;

void paste(Image& sheet, const Image& picture, int left, int top) {
  for (int v = 0; v < picture.height_px(); ++v) {
    for (int u = 0; u < picture.width_px(); ++u) {
      const std::uint8_t* from = picture.at(u, v);
      std::uint8_t* to = sheet.at(left + u, top + v);
      for (int c = 0; c < 3; ++c) {
        to[c] = from[picture.channels() == 3 ? c : 0];
      }
    }
  }
}

}  // namespace

Image contact_sheet(const std::vector<CaptionedImage>& pictures, int columns) {
  const auto per_row = static_cast<std::size_t>(std::max(1, columns));
  const std::size_t rows = (pictures.size() + per_row - 1) / per_row;
  std::vector<int> widths(per_row, 0);
  std::vector<int> heights(rows, 0);
  for (std::size_t n = 0; n < pictures.size(); ++n) {
    widths[n % per_row] = std::max(widths[n % per_row], pictures[n].image.width_px());
    const int caption_px = pictures[n].caption.empty() ? 0 : kCaption_px;
    heights[n / per_row] = std::max(heights[n / per_row], pictures[n].image.height_px() + caption_px);
  }
  int width = kGap_px;
  for (const int w : widths) {
    width += w > 0 ? w + kGap_px : 0;
  }
  int height = kGap_px;
  for (const int h : heights) {
    height += h + kGap_px;
  }
  Image sheet(width, height, 3, 255);
  std::vector<std::pair<Point2, std::string>> captions;
  std::vector<image::Rect> frames;
  int top = kGap_px;
  for (std::size_t row = 0; row < rows; ++row) {
    int left = kGap_px;
    for (std::size_t column = 0; column < per_row && row * per_row + column < pictures.size(); ++column) {
      const CaptionedImage& picture = pictures[row * per_row + column];
      const int caption_px = picture.caption.empty() ? 0 : kCaption_px;
      paste(sheet, picture.image, left, top + caption_px);
      if (caption_px > 0) {
        frames.push_back(
            {left - 0.5, top + caption_px - 0.5, picture.image.width_px() + 1.0, picture.image.height_px() + 1.0});
      }
      captions.emplace_back(Point2(left, top + kCaption_px - 8.0), picture.caption);
      left += widths[column] + kGap_px;
    }
    top += heights[row] + kGap_px;
  }
  image::Canvas canvas(sheet);
  for (const image::Rect& frame : frames) {
    canvas.rect(frame, {image::kLightGrey, 1.0});
  }
  for (const auto& [at, caption] : captions) {
    canvas.text(at, caption, {.size_px = kCaptionText_px});
  }
  return canvas.image();
}

}  // namespace seeker::lab
