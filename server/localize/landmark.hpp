/// \file
/// A landmark: a point of the building that the stereo camera recognises (spec S2.7).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/core/angle.hpp"
#include "server/localize/geometry.hpp"
#include "server/vision/descriptor.hpp"

namespace seeker::localize {

/// Unique identifier, never reused in the life of a database. 0: none.
using LandmarkId = std::uint64_t;

/// Largest number of descriptors of a landmark.
inline constexpr std::size_t kMaxViews = 4;

/// Appearance of a landmark from one side.
struct LandmarkView {
  vision::Descriptor descriptor{};
  /// Unit vector from the landmark to the eye at the first observation from this side.
  Point3 to_eye = Point3::UnitX();
  int seen = 0;  ///< number of observations from this side

  friend bool operator==(const LandmarkView&, const LandmarkView&) = default;
};

struct Landmark {
  LandmarkId id = 0;
  Point3 p_map = Point3::Zero();
  Matrix3 information = Matrix3::Identity();  ///< inverse covariance of p_map, 1/m^2
  Point3 to_eye = Point3::UnitX();            ///< mean unit vector to the eyes that observed it
  double concentration = 1.0;       ///< length of the mean of those vectors: 1 all from one side, 0 from all around
  double scale_m = 0.0;             ///< mean size: blur at which it is detected, at its distance
  std::vector<LandmarkView> views;  ///< one for each side from which it was observed, at least one
  int seen = 0;                     ///< number of sightings that showed it
  int expected = 0;                 ///< number of sightings that should have shown it, including those that did
  int misses = 0;                   ///< number of the last sightings in a row that should have shown it but did not
  double log_odds = 0.0;            ///< log odds that it still exists
  std::uint64_t last_seen = 0;      ///< number of the newest sighting that showed it (LandmarkDatabase::sightings)

  [[nodiscard]] Matrix3 covariance() const;

  friend bool operator==(const Landmark&, const Landmark&) = default;
};

/// Parameters of the fusion of observations into a landmark.
struct FusionParams {
  /// Spec S2.7: the position is the running mean, the descriptor is the first one. Otherwise positions are weighted by
  /// their information and a descriptor is kept for each side.
  bool running_mean = false;
  double view_cluster_rad = deg_to_rad(25.0);  ///< views closer than this belong to one side

  friend bool operator==(const FusionParams&, const FusionParams&) = default;
};

/// Creates a landmark from its first observation, without an id.
[[nodiscard]] Landmark make_landmark(const SeenPoint& point, const vision::Descriptor& descriptor);
/// Fuses one more observation. Existence and counts of expected sightings are not changed.
void fuse(Landmark& landmark, const SeenPoint& point, const vision::Descriptor& descriptor, const FusionParams& params);
/// Merges two landmarks of one point: counts are added, the one with more sightings keeps its views first.
void fuse(Landmark& landmark, const Landmark& other, const FusionParams& params);

}  // namespace seeker::localize
