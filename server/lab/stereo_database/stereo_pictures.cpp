#include "server/lab/stereo_database/stereo_pictures.hpp"

#include "common/image/canvas.hpp"
#include "server/lab/plots/image_tools.hpp"

namespace seeker::lab {
namespace {

constexpr double kMark_px = 6.0;

using PixelLine = std::pair<Point2, Point2>;

/// The centre of the first pixel is (0.5, 0.5) of a canvas.
Point2 on_canvas(double u_px, double v_px) { return {u_px + 0.5, v_px + 0.5}; }

void copy_to(Image& sheet, const Image& grey, int left_px) {
  for (int v = 0; v < grey.height_px(); ++v) {
    for (int u = 0; u < grey.width_px(); ++u) {
      *sheet.at(left_px + u, v) = *grey.at(u, v);
    }
  }
}

Image side_by_side(const StereoFrame& pair, const std::vector<PixelLine>& lines) {
  const Image left = to_grey(pair.left);
  const Image right = to_grey(pair.right);
  Image sheet(left.width_px() + right.width_px(), left.height_px(), 1);
  copy_to(sheet, left, 0);
  copy_to(sheet, right, left.width_px());
  image::Canvas canvas(sheet);
  const Point2 offset(left.width_px(), 0.0);
  for (const auto& [from, to] : lines) {
    canvas.line(from, to + offset, {.colour = image::kGreen, .width_px = 1.5, .alpha = 0.8});
    canvas.circle(from, kMark_px, {.colour = image::kOrange, .width_px = 1.5});
    canvas.circle(to + offset, kMark_px, {.colour = image::kOrange, .width_px = 1.5});
  }
  return canvas.image();
}

void draw(image::Canvas& canvas, const MarkedFeature& feature) {
  const Point2 at = on_canvas(feature.at.u_px, feature.at.v_px);
  const Point2 down(kMark_px, kMark_px);
  const Point2 up(kMark_px, -kMark_px);
  switch (feature.mark) {
    case FeatureMark::kCircle: canvas.circle(at, kMark_px, {.colour = image::kGreen, .width_px = 2.0}); break;
    case FeatureMark::kCross:
      canvas.line(at - down, at + down, {.colour = image::kRed, .width_px = 2.0});
      canvas.line(at - up, at + up, {.colour = image::kRed, .width_px = 2.0});
      break;
    case FeatureMark::kSquare:
      canvas.rect({at.x() - kMark_px, at.y() - kMark_px, 2.0 * kMark_px, 2.0 * kMark_px},
                  {.colour = image::kBlue, .width_px = 2.0});
      break;
  }
}

}  // namespace

Image match_figure(const StereoFrame& pair, const vision::StereoFeatures& seen) {
  std::vector<PixelLine> before;
  for (const vision::KeypointPair& match : seen.before_constraints) {
    before.emplace_back(on_canvas(match.left.u_px, match.left.v_px), on_canvas(match.right.u_px, match.right.v_px));
  }
  std::vector<PixelLine> after;
  for (const vision::StereoFeature& feature : seen.features) {
    const Point2 left = on_canvas(feature.left.u_px, feature.left.v_px);
    after.emplace_back(left, left - Point2(feature.disparity_px, 0.0));
  }
  return contact_sheet({{std::to_string(before.size()) + " matches before the constraints", side_by_side(pair, before)},
                        {std::to_string(after.size()) + " matches after the constraints", side_by_side(pair, after)}},
                       1);
}

Image marked_figure(const std::vector<MarkedView>& views) {
  std::vector<CaptionedImage> sheet;
  for (const MarkedView& view : views) {
    image::Canvas canvas(view.picture);
    for (const MarkedFeature& feature : view.features) {
      draw(canvas, feature);
    }
    sheet.push_back({view.caption, canvas.image()});
  }
  return contact_sheet(sheet, 2);
}

}  // namespace seeker::lab
