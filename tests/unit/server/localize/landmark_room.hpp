/// \file
/// A room of points with made-up descriptors, and what a stereo camera would see of them: for tests without pictures.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "common/core/rng.hpp"
#include "server/localize/survey.hpp"

namespace seeker::localize::testing {

struct RoomPoint {
  Point3 p_map;
  Point2 normal;  ///< of the wall it is on, into the room
  std::array<double, vision::kDescriptorSize> look;
};

struct ViewNoise {
  double sigma_px = 0.3;
  double sigma_disparity_px = 0.2;
  double disparity_offset_px = 0.0;  ///< the same for all features: calibration
  double descriptor = 0.35;          ///< length of the difference between two sights of one point
  double detection = 0.6;            ///< share of the visible points that are found
  double foreign = 0.2;              ///< features of nothing known, as a share of the found ones
};

inline std::array<double, vision::kDescriptorSize> random_look(Rng& rng) {
  std::array<double, vision::kDescriptorSize> look{};
  double square = 0.0;
  for (double& value : look) {
    value = std::pow(rng.normal(1.0), 2);
    square += value * value;
  }
  for (double& value : look) {
    value /= std::sqrt(square);
  }
  return look;
}

inline vision::Descriptor descriptor_of(const std::array<double, vision::kDescriptorSize>& look, double noise,
                                        Rng& rng) {
  vision::Descriptor descriptor{};
  const double sigma = noise / std::sqrt(static_cast<double>(vision::kDescriptorSize));
  for (std::size_t i = 0; i < look.size(); ++i) {
    const double value = std::max(0.0, look[i] + rng.normal(sigma)) * vision::kDescriptorUnit;
    descriptor[i] = static_cast<std::uint8_t>(std::min(255.0, std::round(value)));
  }
  return descriptor;
}

/// Points on the four walls of a square room whose corner is the origin, heights around the eye's.
class LandmarkRoom {
 public:
  LandmarkRoom(std::uint64_t seed, int points, double side_m = 10.0) : side_m_(side_m) {
    Rng rng(seed);
    for (int i = 0; i < points; ++i) {
      add(static_cast<int>(rng.below(4)), rng.uniform(0.2, side_m - 0.2), rng.uniform(-0.8, 1.4), random_look(rng));
    }
  }

  void add(int wall, double along_m, double height_m, const std::array<double, vision::kDescriptorSize>& look) {
    static const std::array<Point2, 4> kNormals = {Point2(0, 1), Point2(-1, 0), Point2(0, -1), Point2(1, 0)};
    const std::array<Point2, 4> places = {Point2(along_m, 0.0), Point2(side_m_, along_m), Point2(along_m, side_m_),
                                          Point2(0.0, along_m)};
    const auto w = static_cast<std::size_t>(wall);
    points_.push_back({{places[w].x(), places[w].y(), height_m}, kNormals[w], look});
  }
  [[nodiscard]] std::vector<RoomPoint>& points() { return points_; }

  /// Features that an eye at the origin's height sees from `map_T_eye`.
  [[nodiscard]] std::vector<vision::StereoFeature> view(const Pose2& map_T_eye, const StereoGeometry& geometry,
                                                        const ViewNoise& noise, Rng& rng) const {
    std::vector<vision::StereoFeature> features;
    for (const RoomPoint& point : points_) {
      const Point3 p_eye = to_eye(map_T_eye, 0.0, point.p_map);
      const auto pixel = project(geometry, p_eye);
      const bool facing = point.normal.dot(map_T_eye.translation() - point.p_map.head<2>()) > 0.0;
      if (!pixel || !facing || rng.uniform() > noise.detection) {
        continue;
      }
      features.push_back(feature_at(*pixel, p_eye.x(), descriptor_of(point.look, noise.descriptor, rng), noise, rng));
    }
    const auto foreign = static_cast<std::size_t>(noise.foreign * static_cast<double>(features.size()));
    for (std::size_t i = 0; i < foreign; ++i) {
      const Pixel pixel{rng.uniform(0.0, geometry.width_px), rng.uniform(0.0, geometry.height_px),
                        rng.uniform(13.0, 60.0)};
      features.push_back(feature_at(pixel, 3.0, descriptor_of(random_look(rng), 0.0, rng), noise, rng));
    }
    return features;
  }

 private:
  static vision::StereoFeature feature_at(const Pixel& pixel, double ahead_m, const vision::Descriptor& descriptor,
                                          const ViewNoise& noise, Rng& rng) {
    vision::StereoFeature feature;
    feature.left.u_px = static_cast<float>(pixel.u_px + rng.normal(noise.sigma_px));
    feature.left.v_px = static_cast<float>(pixel.v_px + rng.normal(noise.sigma_px));
    feature.left.scale_px = static_cast<float>(8.0 / ahead_m);
    feature.disparity_px =
        std::max(0.5, pixel.disparity_px + noise.disparity_offset_px + rng.normal(noise.sigma_disparity_px));
    feature.descriptor = descriptor;
    return feature;
  }

  double side_m_;
  std::vector<RoomPoint> points_;
};

/// Five places, twelve headings each (spec S2.4).
inline std::vector<Pose2> survey_truth() {
  constexpr int kHeadings = 12;
  std::vector<Pose2> truth;
  for (const Point2& place :
       {Point2(5.0, 5.0), Point2(3.0, 3.0), Point2(7.0, 3.0), Point2(7.0, 7.0), Point2(3.0, 7.0)}) {
    for (int k = 0; k < kHeadings; ++k) {
      truth.push_back({place.x(), place.y(), wrap_angle(k * kTwoPi / kHeadings)});
    }
  }
  return truth;
}

/// From there, poses known to `sigma_m` and `sigma_rad`.
inline std::vector<Sighting> survey_sightings(const LandmarkRoom& room, const StereoGeometry& geometry,
                                              const ViewNoise& noise, Rng& rng, double sigma_m = 0.005,
                                              double sigma_rad = 0.002) {
  std::vector<Sighting> sightings;
  for (const Pose2& truth : survey_truth()) {
    Sighting sighting;
    sighting.map_T_eye = {truth.x_m + rng.normal(sigma_m), truth.y_m + rng.normal(sigma_m),
                          truth.theta_rad + rng.normal(sigma_rad)};
    sighting.pose_covariance =
        Eigen::Vector3d(sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad).asDiagonal();
    sighting.features = room.view(truth, geometry, noise, rng);
    sightings.push_back(std::move(sighting));
  }
  return sightings;
}

inline LandmarkDatabase survey(const LandmarkRoom& room, const StereoGeometry& geometry, const DatabaseParams& params,
                               std::uint64_t seed, const ViewNoise& noise = {}) {
  Rng rng(seed);
  SurveyBuilder builder(geometry, params);
  for (const Sighting& sighting : survey_sightings(room, geometry, noise, rng)) {
    EXPECT_TRUE(builder.add(sighting).has_value());
  }
  return builder.salient();
}

inline std::shared_ptr<const LandmarkDatabase> surveyed(const LandmarkRoom& room, std::uint64_t seed,
                                                        const DatabaseParams& params = {},
                                                        const ViewNoise& noise = {}) {
  return std::make_shared<LandmarkDatabase>(survey(room, {}, params, seed, noise));
}

}  // namespace seeker::localize::testing
