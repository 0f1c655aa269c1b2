/// \file
/// One landmark: a point of the building that the stereo camera knows again (spec S2.7).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/core/angle.hpp"
#include "server/localize/geometry.hpp"
#include "server/vision/descriptor.hpp"

namespace seeker::localize {

/// Never given out twice in the life of a database. 0: none.
using LandmarkId = std::uint64_t;

/// Most descriptors a landmark keeps.
inline constexpr std::size_t kMaxViews = 4;

/// How a landmark looks from one side.
struct LandmarkView {
  vision::Descriptor descriptor{};
  Point3 to_eye = Point3::UnitX();  ///< unit vector from the landmark to the eye that saw it so first
  int seen = 0;                     ///< sightings from this side

  friend bool operator==(const LandmarkView&, const LandmarkView&) = default;
};

struct Landmark {
  LandmarkId id = 0;
  Point3 p_map = Point3::Zero();
  Matrix3 information = Matrix3::Identity();  ///< inverse covariance of p_map, 1/m^2
  Point3 to_eye = Point3::UnitX();            ///< mean unit vector to the eyes that saw it
  double concentration = 1.0;       ///< length of the mean of those vectors: 1 all from one side, 0 from everywhere
  double scale_m = 0.0;             ///< mean size: blur at which it is found, at its distance
  std::vector<LandmarkView> views;  ///< one for each side it was seen from, at least one
  int seen = 0;                     ///< sightings that showed it
  int expected = 0;                 ///< sightings that should have shown it, those that did included
  int misses = 0;                   ///< of these the last ones in a row that did not
  double log_odds = 0.0;            ///< of its still being there
  std::uint64_t last_seen = 0;      ///< number of the newest sighting that showed it (LandmarkDatabase::sightings)

  [[nodiscard]] Matrix3 covariance() const;
  /// Spread of the directions it was seen from (circular standard deviation).
  [[nodiscard]] double direction_spread_rad() const;

  friend bool operator==(const Landmark&, const Landmark&) = default;
};

/// How observations change a landmark.
struct FusionParams {
  /// Spec S2.7: position = running mean, descriptor = the first one. Else positions are weighted by their certainty
  /// and a descriptor is kept for each side.
  bool running_mean = false;
  double view_cluster_rad = deg_to_rad(25.0);  ///< views closer than this are of one side

  friend bool operator==(const FusionParams&, const FusionParams&) = default;
};

/// A landmark from its first observation; without an id.
[[nodiscard]] Landmark make_landmark(const SeenPoint& point, const vision::Descriptor& descriptor);
/// One more observation. Existence and counts of expectation are not touched.
void fuse(Landmark& landmark, const SeenPoint& point, const vision::Descriptor& descriptor, const FusionParams& params);
/// Two landmarks that are one: counts are added, the one with more sightings keeps its views first.
void fuse(Landmark& landmark, const Landmark& other, const FusionParams& params);

}  // namespace seeker::localize
