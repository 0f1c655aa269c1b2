#include "server/vision/view_features.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/core/angle.hpp"
#include "common/core/assert.hpp"
#include "server/vision/bounds.hpp"
#include "server/vision/sift_features.hpp"

namespace seeker::vision {
namespace {

/// The rotation with which most differences agree, and their number. `differences_rad` are sorted, in (-pi, pi].
struct Agreement {
  int count = 0;
  double middle_rad = 0.0;
};

Agreement largest_agreement(const std::vector<double>& differences_rad, double half_width_rad) {
  const std::size_t count = differences_rad.size();
  // Each once more, one circle further, so that no interval is cut at +-pi.
  const auto at = [&](std::size_t k) { return k < count ? differences_rad[k] : differences_rad[k - count] + kTwoPi; };
  Agreement best;
  std::size_t end = 0;
  for (std::size_t begin = 0; begin < count; ++begin) {
    end = std::max(end, begin);
    while (end < begin + count && at(end) - at(begin) <= 2.0 * half_width_rad) {
      ++end;
    }
    const auto size = static_cast<int>(end - begin);
    if (size > best.count) {
      best = {size, wrap_angle(at(begin + (end - begin) / 2))};
    }
  }
  return best;
}

}  // namespace

ViewFeatureExtractor::ViewFeatureExtractor(const ViewParams& view, const DetectorParams& detector)
    : view_(view), detector_(detector) {
  SEEKER_ASSERT(validate(detector_).has_value());
}

Result<ViewFeatures> ViewFeatureExtractor::extract(const Image& picture) const {
  const Result<cv::Mat> working = view_.working_picture(picture);
  if (!working) {
    return tl::unexpected<Error>(working.error());
  }
  // The columns beyond a full circle show again what the first ones show: a feature there would have a twin.
  const int columns = std::min(working->cols, view_.circle_columns());
  const FeatureList found = detect_sift((*working)(cv::Rect(0, 0, columns, working->rows)), detector_);
  ViewFeatures features;
  features.bearings_rad.reserve(found.size());
  for (const Keypoint& key : found.keypoints) {
    features.bearings_rad.push_back(static_cast<float>(
        view_.bearing_base_rad({static_cast<double>(key.u_px), static_cast<double>(key.v_px)}, working->size())));
  }
  features.descriptors = found.descriptors;
  return features;
}

Status validate(const ViewMatchParams& p) {
  return check_bounds(std::array<Bound, 7>{{{"views.match.max_distance", p.match.max_distance, 0.01, 20.0},
                                            {"views.match.max_ratio", p.match.max_ratio, 0.1, 1.0},
                                            {"views.min_matches", static_cast<double>(p.min_matches), 1.0, 1000.0},
                                            {"views.min_share", p.min_share, 0.0, 1.0},
                                            {"views.min_agreement", p.min_agreement, 0.0, 1.0},
                                            {"views.min_agreeing", static_cast<double>(p.min_agreeing), 0.0, 1000.0},
                                            {"views.max_parallax_rad", p.max_parallax_rad, 0.0, kPi}}});
}

std::optional<ViewMatch> match_views(const ViewFeatures& first, const ViewFeatures& second,
                                     const ViewMatchParams& params) {
  const std::vector<FeatureMatch> matches = match_mutually(first.descriptors, second.descriptors, params.match);
  const auto smaller = static_cast<double>(std::min(first.size(), second.size()));
  const auto count = static_cast<double>(matches.size());
  if (matches.size() < static_cast<std::size_t>(params.min_matches) || count < params.min_share * smaller) {
    return std::nullopt;
  }
  std::vector<double> differences_rad;
  differences_rad.reserve(matches.size());
  for (const FeatureMatch& match : matches) {
    differences_rad.push_back(
        wrap_angle(static_cast<double>(first.bearings_rad[static_cast<std::size_t>(match.first)]) -
                   static_cast<double>(second.bearings_rad[static_cast<std::size_t>(match.second)])));
  }
  std::sort(differences_rad.begin(), differences_rad.end());
  const Agreement agreement = largest_agreement(differences_rad, params.max_parallax_rad);
  if (agreement.count < params.min_agreeing || static_cast<double>(agreement.count) < params.min_agreement * count) {
    return std::nullopt;
  }
  return ViewMatch{static_cast<int>(matches.size()), agreement.count, agreement.middle_rad};
}

}  // namespace seeker::vision
