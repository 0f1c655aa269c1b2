/// \file
/// Sightings -> detections: which sightings are the same thing, where it is, whether to believe it (spec S3.5).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "common/core/map_move.hpp"
#include "common/core/pose2.hpp"
#include "common/core/scan.hpp"
#include "server/search/detection_params.hpp"
#include "server/search/search_types.hpp"
#include "server/search/triangulation.hpp"
#include "server/vision/sighting.hpp"

namespace seeker::search {

/// Everything one picture gave.
struct Look {
  RobotTime stamp;
  Pose2 map_T_base;
  Matrix3 pose_covariance = Matrix3::Zero();
  std::vector<vision::Sighting> sightings;
  const LaserScan* laser = nullptr;
  const SonarScan* sonar = nullptr;
};

/// Joins sightings to tracks by Mahalanobis distance, fuses their positions, confirms and refutes. A track is confirmed
/// when `confirm_places` places saw it or one score is at least `sure_score`; an unconfirmed track is refuted when
/// looks in vain outnumber its sightings by max_misses.
class DetectionTracker {
 public:
  DetectionTracker(std::vector<SearchTarget> targets, const DetectionParams& params);

  /// Takes one picture. Returns the ids of the tracks it touched, in the order of the sightings.
  std::vector<std::uint64_t> add(const Look& look);

  /// Negative evidence: `should_see(p_map, target)` tells the probability that the picture just taken from
  /// `map_T_base` would have shown the target at a place. `seen`: what add() returned.
  using ShouldSee = std::function<double(const Point2& p_map, int target)>;
  /// Returns the ids of the tracks that this refuted (they are gone).
  std::vector<std::uint64_t> note_misses(const std::vector<std::uint64_t>& seen, const ShouldSee& should_see);
  /// The mission looked for confirmation in vain.
  void refute(std::uint64_t id);

  [[nodiscard]] std::vector<Detection> detections() const;
  [[nodiscard]] std::optional<Detection> find(std::uint64_t id) const;
  /// Where the track was seen from, one entry per place.
  [[nodiscard]] std::vector<Point2> places(std::uint64_t id) const;
  void transform(const MapMove& move);

 private:
  struct Observation {
    BearingRange measurement;
    double score = 0.0;
    RangeSource source = RangeSource::kNone;
  };
  struct Track {
    Detection detection;
    std::vector<Observation> observations;
    std::vector<Point2> places;
    Matrix3 pose_covariance = Matrix3::Zero();  ///< of the newest sighting
  };

  [[nodiscard]] Observation observe(const Look& look, const vision::Sighting& sighting) const;
  [[nodiscard]] std::optional<double> distance(const Track& track, const Observation& observation,
                                               const Look& look) const;
  [[nodiscard]] Track* match(const Observation& observation, int target, const Look& look,
                             const std::vector<std::uint64_t>& taken);
  void join(Track& track, const Observation& observation, const vision::Sighting& sighting, const Look& look);
  void estimate(Track& track) const;

  std::vector<SearchTarget> targets_;
  DetectionParams params_;
  std::vector<Track> tracks_;
  std::uint64_t next_id_ = 1;
};

}  // namespace seeker::search
