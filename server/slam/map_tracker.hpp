/// \file
/// A pose tracker with a map that can be displayed, saved, loaded and localised in.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "common/core/line_map.hpp"
#include "server/slam/pose_tracker.hpp"

namespace seeker::slam {

/// What a loaded map is used for.
enum class MapUse : std::uint8_t {
  kContinue,  ///< the map continues to grow
  kLocalise,  ///< the map is only read: observations outside it are discarded
};

class SpMap;

/// The filter of robot and newest walls, for predictions of the robot's future uncertainty.
struct LocalBelief {
  const SpMap* lines = nullptr;  ///< never null; valid until the tracker's next call
  Pose2 map_T_lines;             ///< the filter's own frame in the frame `map`
};

/// A part of the map that moves as a rigid body when the map is corrected.
struct MapPiece {
  std::uint32_t id = 0;                  ///< identifier that is stable across corrections
  Pose2 map_T_piece;                     ///< pose of the piece's frame
  Point2 middle_piece = Point2::Zero();  ///< approximate centre in the piece's own frame
};

class MapTracker : public PoseTracker {
 public:
  /// Segments of the whole map in the frame `map`, one per piece of wall.
  [[nodiscard]] virtual std::vector<MapSegment> segments() const = 0;
  /// Rises with every change of segments().
  [[nodiscard]] virtual std::uint64_t revision() const = 0;
  /// Robot and segments of its surroundings with their joint covariance; no value before the first scan.
  [[nodiscard]] virtual std::optional<LocalBelief> local_belief() const { return std::nullopt; }
  /// The present poses of the parts of the map; empty when the map moves as one rigid body.
  [[nodiscard]] virtual std::vector<MapPiece> pieces() const { return {}; }
  /// The whole map, for a file.
  [[nodiscard]] virtual LineMap map() const = 0;
  /// Replaces the map. The pose is unknown (kUnknown) until relocalise() or the scans have found it.
  /// kInvalidArgument: see validate(LineMap).
  [[nodiscard]] virtual Status load(const LineMap& map, MapUse use) = 0;
  /// Searches for the robot in the map, near `map_T_base` where given, else everywhere, from the next scans on. The
  /// estimate is kUnknown meanwhile, and kLost with a cause when the robot cannot be found. Fails with kNotReady when
  /// there is no map.
  [[nodiscard]] virtual Status relocalise(const std::optional<Pose2>& map_T_base) = 0;
  /// As relocalise(), but the robot probably still stands at `map_T_base`, its last known pose, which is accepted where
  /// scans agree with the map there although they fit elsewhere, too. Otherwise the search is extended to the
  /// surroundings, since the robot may have driven on, and then to the whole map.
  [[nodiscard]] virtual Status look_where_it_stood(const Pose2& map_T_base) = 0;
  /// Visits the kept scans at their present poses, from which occupancy is rendered after the map has moved.
  virtual void for_each_scan(
      const std::function<void(const LaserScan& scan, const Pose2& map_T_base)>& visit) const = 0;
};

}  // namespace seeker::slam
