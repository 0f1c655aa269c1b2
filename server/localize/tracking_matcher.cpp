#include "server/localize/tracking_matcher.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace seeker::localize {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

/// Features of a picture by the square they lie in.
class FeatureSquares {
 public:
  FeatureSquares(const StereoGeometry& geometry, std::span<const vision::StereoFeature> features,
                 std::span<const EyeFeature> lifted)
      : columns_(geometry.width_px / kSide_px + 1),
        rows_(geometry.height_px / kSide_px + 1),
        squares_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {
    for (std::size_t i = 0; i < lifted.size(); ++i) {
      const vision::Keypoint& at = features[lifted[i].feature].left;
      squares_[index(column(at.u_px), row(at.v_px))].push_back(i);
    }
  }

  template <class Visit>
  void for_window(const Pixel& centre, double half_width_px, double half_height_px, Visit visit) const {
    for (int r = row(centre.v_px - half_height_px); r <= row(centre.v_px + half_height_px); ++r) {
      for (int c = column(centre.u_px - half_width_px); c <= column(centre.u_px + half_width_px); ++c) {
        for (const std::size_t i : squares_[index(c, r)]) {
          visit(i);
        }
      }
    }
  }

 private:
  static constexpr int kSide_px = 32;
  static int square(double px, int count) {
    return static_cast<int>(std::clamp(px / kSide_px, 0.0, static_cast<double>(count - 1)));
  }
  [[nodiscard]] int column(double u_px) const { return square(u_px, columns_); }
  [[nodiscard]] int row(double v_px) const { return square(v_px, rows_); }
  [[nodiscard]] std::size_t index(int c, int r) const {
    return static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(c);
  }

  int columns_;
  int rows_;
  std::vector<std::vector<std::size_t>> squares_;
};

/// Best and second best partner so far.
struct Choice {
  std::size_t partner = kNone;
  double distance = std::numeric_limits<double>::max();
  double second = std::numeric_limits<double>::max();

  void offer(std::size_t candidate, double candidate_distance) {
    if (candidate_distance < distance) {
      second = distance;
      distance = candidate_distance;
      partner = candidate;
    } else {
      second = std::min(second, candidate_distance);
    }
  }
};

/// Half width and height of the window in which a landmark's feature is looked for.
Eigen::Vector2d window_px(const StereoGeometry& geometry, const EyeBelief& belief, const Landmark& landmark,
                          const Matrix3& covariance, const LocaliserParams& params) {
  const Point2 offset = landmark.p_map.head<2>() - belief.map_T_eye.translation();
  const double range = std::max(offset.norm(), params.range.min_m);
  const Eigen::RowVector3d by_pose(offset.y() / (range * range), -offset.x() / (range * range), -1.0);
  const double own = covariance.topLeftCorner<2, 2>().trace() / (range * range);
  const double sigma_rad = std::sqrt(by_pose * belief.pose_covariance() * by_pose.transpose() + own);
  const double across_px = std::sqrt(params.tracking.gate_chi2) * sigma_rad * geometry.focal_px;
  const double height_px = params.tracking.height_tolerance_m / range * geometry.focal_px;
  return {std::max(across_px, params.tracking.min_window_px), std::max(height_px, params.tracking.min_window_px)};
}

}  // namespace

std::vector<ExpectedLandmark> expected_landmarks(const StereoGeometry& geometry, const LandmarkMap& map,
                                                 const EyeBelief& belief, const LocaliserParams& params) {
  std::vector<ExpectedLandmark> expected;
  const Pose2& map_T_eye = belief.map_T_eye;
  const Point3 eye(map_T_eye.x_m, map_T_eye.y_m, params.eye_height_m);
  const double cos_side = std::cos(params.tracking.max_view_angle_rad);
  const bool paper = params.mode == FilterMode::kPaper;
  map.database->for_near(eye, params.range.max_m, [&](std::size_t index) {
    const Landmark& landmark = map.at(index);
    Point3 p_eye = to_eye(map_T_eye, params.eye_height_m, landmark.p_map);
    if (paper) {
      p_eye.z() = 0.0;  // the paper asks for range and bearing only, from any side
    }
    const auto pixel = project(geometry, p_eye);
    if (!pixel || p_eye.head<2>().norm() < params.range.min_m) {
      return;
    }
    const Point3 to_eye_now = (eye - landmark.p_map).normalized();
    const bool known_side =
        paper || std::any_of(landmark.views.begin(), landmark.views.end(),
                             [&](const LandmarkView& view) { return view.to_eye.dot(to_eye_now) >= cos_side; });
    if (known_side) {
      expected.push_back({index, *pixel});
    }
  });
  std::sort(expected.begin(), expected.end(), [](const auto& a, const auto& b) { return a.landmark < b.landmark; });
  return expected;
}

std::vector<Pairing> match_in_windows(const StereoGeometry& geometry, const LandmarkMap& map, const EyeBelief& belief,
                                      std::span<const vision::StereoFeature> features,
                                      std::span<const EyeFeature> lifted, std::span<const ExpectedLandmark> expected,
                                      const LocaliserParams& params) {
  const FeatureSquares squares(geometry, features, lifted);
  std::vector<Choice> of_features(lifted.size());
  std::vector<Choice> of_landmarks(expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) {
    const Landmark& landmark = map.at(expected[k].landmark);
    const Matrix3& covariance = map.covariances[expected[k].landmark];
    const Eigen::Vector2d half = window_px(geometry, belief, landmark, covariance, params);
    squares.for_window(expected[k].pixel, half.x(), half.y(), [&](std::size_t i) {
      const double distance = landmark_distance(landmark, features[lifted[i].feature].descriptor, params.metric);
      if (distance > params.tracking.max_distance ||
          !heights_agree(lifted[i], map, expected[k].landmark, params.tracking.height_tolerance_m, params)) {
        return;
      }
      const auto innovation = innovate(belief, with_landmark(lifted[i], map, expected[k].landmark, 1.0, params));
      if (innovation && innovation->chi2 <= params.tracking.gate_chi2) {
        of_features[i].offer(k, distance);
        of_landmarks[k].offer(i, distance);
      }
    });
  }
  std::vector<Pairing> pairs;
  for (std::size_t i = 0; i < lifted.size(); ++i) {
    const Choice& choice = of_features[i];
    if (choice.partner != kNone && of_landmarks[choice.partner].partner == i &&
        choice.distance <= params.tracking.max_ratio * choice.second) {
      pairs.push_back({i, expected[choice.partner].landmark, choice.distance});
    }
  }
  return pairs;
}

std::vector<std::size_t> agreeing(const EyeBelief& belief, std::span<const RangeBearing> seen,
                                  const TrackingParams& params) {
  std::vector<std::size_t> best;
  const std::size_t step = std::max<std::size_t>(1, seen.size() / static_cast<std::size_t>(params.max_votes));
  for (std::size_t voter = 0; voter < seen.size(); voter += step) {
    EyeBelief corrected = belief;
    static_cast<void>(update_sequentially(corrected, seen.subspan(voter, 1)));
    std::vector<std::size_t> group;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const auto innovation = innovate(corrected, seen[i]);
      if (innovation && innovation->chi2 <= params.vote_chi2) {
        group.push_back(i);
      }
    }
    if (group.size() > best.size()) {
      best = std::move(group);
    }
  }
  return best;
}

}  // namespace seeker::localize
