/// \file
/// Checks whether a scan at a pose contradicts a map: beams through surfaces, and points in free space.
#pragma once

#include <vector>

#include "common/core/scan.hpp"
#include "server/slam/likelihood_pyramid.hpp"

namespace seeker::slam {

/// The points of one scan and the position of the laser that observed them, in one frame.
struct SeenPoints {
  Point2 origin = Point2::Zero();
  std::vector<OrientedPoint> points;
};

/// The scan's points on surfaces, in the frame `base`.
[[nodiscard]] SeenPoints seen_points(const LaserScan& scan, const NormalParams& params = {});
[[nodiscard]] SeenPoints transform(const Pose2& a_T_b, const SeenPoints& seen_b);

struct FreeSpaceParams {
  double resolution_m = 0.1;
  double end_margin_m = 0.3;  ///< length of the end of a beam that is not evaluated
  double max_range_m = 15.0;  ///< range beyond which a beam is not evaluated
  int min_beams = 3;          ///< number of beams through a free cell
  int min_points = 2;         ///< number of points in a solid cell
  /// Share of points among the points and beams of a solid cell: doors move and people walk.
  double solid_ratio = 0.5;
  std::size_t max_cells = 100'000'000;
};

/// Occupancy of the map's cells by beams: free where beams passed and no point was ever observed in the cell or beside
/// it; solid where beams were stopped; passed where beams went through, whether or not a point was observed there at
/// another time.
class FreeSpace {
 public:
  enum class State : std::uint8_t { kUnknown, kFree, kPassed, kSolid };

  explicit FreeSpace(const std::vector<SeenPoints>& seen_map, const FreeSpaceParams& params = {});
  [[nodiscard]] bool is_free(const Point2& p_map) const { return state(p_map) == State::kFree; }
  [[nodiscard]] bool is_solid(const Point2& p_map) const { return state(p_map) == State::kSolid; }
  /// Free space, or a cell from which an observed obstacle has gone or in which it appeared later.
  [[nodiscard]] bool is_passed(const Point2& p_map) const {
    return state(p_map) == State::kFree || state(p_map) == State::kPassed;
  }

 private:
  [[nodiscard]] State state(const Point2& p_map) const {
    const CellIndex cell = states_.frame().cell_of(p_map);
    return states_.contains(cell) ? states_[cell] : State::kUnknown;
  }
  Grid<State> states_;
};

struct AgreementParams {
  int solid = 140;       ///< likelihood of a cell that stops a beam (one sigma of the field away)
  double step_m = 0.07;  ///< step along the beam
  double near_m = 0.3;   ///< range below which a beam is not evaluated: the robot's own surroundings
  /// Length of the end of a beam that is not evaluated, because of inexact poses and walls seen at an angle.
  double end_margin_m = 0.35;
  double max_range_m = 15.0;
  std::size_t max_beams = 180;  ///< number of beams of each scan
};

/// Shares of the beams, 0 to 1.
struct Agreement {
  double through = 0.0;  ///< beams that pass through a solid surface of the map that faces them
  double in_free = 0.0;  ///< beams that end in space known to be free: people, moved furniture or a wrong pose
  [[nodiscard]] double disagreement() const { return through + in_free; }
};

/// The agreement of scans in the frame `base` with the base at map_T_base. Zero without points.
[[nodiscard]] Agreement agreement_of(const LikelihoodPyramid& map, const FreeSpace& free_space,
                                     const std::vector<SeenPoints>& seen_base, const Pose2& map_T_base,
                                     const AgreementParams& params = {});

/// Mean likelihood of points at a pose, 0 to 1.
struct Fit {
  double all = 0.0;
  double standing = 0.0;  ///< without the points in free space: static surfaces only
};

/// The fit of points that were thinned by cells, so that near walls do not outweigh far ones. Zero without points.
[[nodiscard]] Fit fit_of(const LikelihoodPyramid& map, const FreeSpace& free_space,
                         const std::vector<OrientedPoint>& points_base, const Pose2& map_T_base);

}  // namespace seeker::slam
