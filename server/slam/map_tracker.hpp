/// \file
/// A pose tracker that keeps a map which can be looked at, saved, loaded and found again.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "common/core/line_map.hpp"
#include "server/slam/pose_tracker.hpp"

namespace seeker::slam {

/// What a loaded map is used for.
enum class MapUse : std::uint8_t {
  kContinue,  ///< the map grows on
  kLocalise,  ///< the map is only read: whatever is seen beside it is forgotten
};

class SpMap;

/// The filter of robot and newest walls, for predictions of what the robot will know.
struct LocalBelief {
  const SpMap* lines = nullptr;  ///< never null; valid until the tracker's next call
  Pose2 map_T_lines;             ///< the filter's own frame in the frame `map`
};

/// A part of the map that moves as a whole when the map is corrected.
struct MapPiece {
  std::uint32_t id = 0;                  ///< the same from one correction to the next
  Pose2 map_T_piece;                     ///< of its frame
  Point2 middle_piece = Point2::Zero();  ///< about where it lies, in its own frame
};

class MapTracker : public PoseTracker {
 public:
  /// Segments of the whole map in the frame `map`, one per piece of wall.
  [[nodiscard]] virtual std::vector<MapSegment> segments() const = 0;
  /// Rises with every change of segments().
  [[nodiscard]] virtual std::uint64_t revision() const = 0;
  /// Robot and segments of the place around it with their joint covariance; nothing before the first scan.
  [[nodiscard]] virtual std::optional<LocalBelief> local_belief() const { return std::nullopt; }
  /// Where the parts of the map lie now; none: it moves as a whole.
  [[nodiscard]] virtual std::vector<MapPiece> pieces() const { return {}; }
  /// The whole map, for a file.
  [[nodiscard]] virtual LineMap map() const = 0;
  /// Replaces the map. The pose is unknown (kUnknown) until relocalise() or the scans have found it.
  /// kInvalidArgument: see validate(LineMap).
  [[nodiscard]] virtual Status load(const LineMap& map, MapUse use) = 0;
  /// Looks for the robot in the map: near `map_T_base` where given, else everywhere, from the next scans on. The
  /// estimate is kUnknown meanwhile, and kLost with a cause when it cannot be found. kNotReady: there is no map.
  [[nodiscard]] virtual Status relocalise(const std::optional<Pose2>& map_T_base) = 0;
  /// As relocalise(), but the robot probably still stands at `map_T_base`, where it was seen last: taken at its word
  /// where scans agree with the map there, although they fit elsewhere, too. Else it is looked for a little farther
  /// about, for it went on, and everywhere.
  [[nodiscard]] virtual Status look_where_it_stood(const Pose2& map_T_base) = 0;
  /// The kept scans at their present poses: what occupancy is rendered from after the map has moved.
  virtual void for_each_scan(
      const std::function<void(const LaserScan& scan, const Pose2& map_T_base)>& visit) const = 0;
};

}  // namespace seeker::slam
