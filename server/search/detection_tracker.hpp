/// \file
/// Fusion of sightings into detections: which sightings belong to the same object, its position, and whether it is
/// confirmed (spec S3.5).
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

/// All data of one picture.
struct Look {
  RobotTime stamp;
  Pose2 map_T_base;
  Matrix3 pose_covariance = Matrix3::Zero();
  std::vector<vision::Sighting> sightings;
  const LaserScan* laser = nullptr;
  const SonarScan* sonar = nullptr;
};

/// Joins sightings to tracks by Mahalanobis distance, fuses their positions, confirms and refutes. A track is confirmed
/// when `confirm_places` places saw it or one score is at least `sure_score`. An unconfirmed track is refuted when its
/// misses outnumber its sightings by max_misses.
class DetectionTracker {
 public:
  DetectionTracker(std::vector<SearchTarget> targets, const DetectionParams& params);

  /// Adds one picture. Returns the ids of the tracks that it changed, in the order of the sightings.
  std::vector<std::uint64_t> add(const Look& look);

  /// Negative evidence: `should_see(p_map, target)` returns the probability that the picture just taken would have
  /// shown the target at a place. `seen` is the result of add().
  using ShouldSee = std::function<double(const Point2& p_map, int target)>;
  /// Records the misses of a picture and returns the ids of the tracks that they refuted and that are removed.
  std::vector<std::uint64_t> note_misses(const std::vector<std::uint64_t>& seen, const ShouldSee& should_see);
  /// Removes a track that the mission could not confirm.
  void refute(std::uint64_t id);

  [[nodiscard]] std::vector<Detection> detections() const;
  [[nodiscard]] std::optional<Detection> find(std::uint64_t id) const;
  /// The places from which the track was seen, one entry per place.
  [[nodiscard]] std::vector<Point2> places(std::uint64_t id) const;
  /// Where the track stands: its position, or as far away as its apparent size says.
  [[nodiscard]] std::optional<Point2> presumed_place(std::uint64_t id) const;
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
    std::optional<Point2> by_size_map;  ///< the place as far away as the newest sighting's apparent size says
    double unseen = 1.0;  ///< probability that a target there stays unseen in all pictures since that did not show it
    Matrix3 pose_covariance = Matrix3::Zero();  ///< covariance of the robot's pose at the newest sighting
  };

  [[nodiscard]] const Track* track_of(std::uint64_t id) const;
  [[nodiscard]] static std::optional<Point2> presumed_place_of(const Track& track) {
    return track.detection.position_map ? track.detection.position_map : track.by_size_map;
  }
  [[nodiscard]] Observation observe(const Look& look, const vision::Sighting& sighting) const;
  [[nodiscard]] std::optional<double> distance(const Track& track, const Observation& observation,
                                               const Look& look) const;
  [[nodiscard]] Track* match(const Observation& observation, int target, const Look& look,
                             const std::vector<std::uint64_t>& taken);
  void join(Track& track, const Observation& observation, const vision::Sighting& sighting, const Look& look);
  void estimate(Track& track) const;
  /// Records that a picture which shows a target at the track's place with probability p did not show it; whether that
  /// refutes the track.
  [[nodiscard]] bool miss(Track& track, double p) const;

  std::vector<SearchTarget> targets_;
  DetectionParams params_;
  std::vector<Track> tracks_;
  std::uint64_t next_id_ = 1;
};

}  // namespace seeker::search
