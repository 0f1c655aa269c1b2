#include "server/vision/stage_pictures.hpp"

#include <opencv2/imgproc.hpp>

#include "server/vision/picture.hpp"

namespace seeker::vision {
namespace {

// Red, green, blue, as in Image.
const cv::Scalar kDarkColour(60, 120, 255);
const cv::Scalar kLightColour(255, 150, 30);
const cv::Scalar kSightingColour(0, 220, 70);
constexpr int kCross_px = 4;

cv::Mat colour_of(const cv::Mat& grey) {
  cv::Mat colour;
  cv::cvtColor(grey, colour, cv::COLOR_GRAY2RGB);
  return colour;
}

}  // namespace

Image draw_regions(const cv::Mat& grey, const std::vector<Region>& regions) {
  cv::Mat canvas = colour_of(grey);
  for (const Region& region : regions) {
    cv::rectangle(canvas, region.box, region.light ? kLightColour : kDarkColour);
  }
  return to_image(canvas);
}

Image draw_points(const cv::Mat& grey, const std::vector<cv::Point2f>& points) {
  cv::Mat canvas = colour_of(grey);
  for (const cv::Point2f& p : points) {
    cv::circle(canvas, cv::Point(cvRound(p.x), cvRound(p.y)), 2, kLightColour);
  }
  return to_image(canvas);
}

Image draw_sightings(const Image& picture, const std::vector<Sighting>& sightings) {
  cv::Mat canvas = colour_of(to_grey_mat(picture));
  for (const Sighting& s : sightings) {
    cv::rectangle(canvas, cv::Rect(s.box.left_px, s.box.top_px, s.box.width_px, s.box.height_px), kSightingColour);
    const cv::Point centre(cvRound(s.u_px), cvRound(s.v_px));
    cv::line(canvas, centre - cv::Point(kCross_px, 0), centre + cv::Point(kCross_px, 0), kSightingColour);
    cv::line(canvas, centre - cv::Point(0, kCross_px), centre + cv::Point(0, kCross_px), kSightingColour);
  }
  return to_image(canvas);
}

}  // namespace seeker::vision
