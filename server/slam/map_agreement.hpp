/// \file
/// Does a scan at a pose contradict a map? Beams through surfaces, and points where the map saw nothing.
#pragma once

#include <vector>

#include "common/core/scan.hpp"
#include "server/slam/likelihood_pyramid.hpp"

namespace seeker::slam {

/// The points of one scan and the place of the laser that saw them, in one frame.
struct SeenPoints {
  Point2 origin = Point2::Zero();
  std::vector<OrientedPoint> points;
};

/// The scan's points on surfaces, in the frame `base`.
[[nodiscard]] SeenPoints seen_points(const LaserScan& scan, const NormalParams& params = {});
[[nodiscard]] SeenPoints transform(const Pose2& a_T_b, const SeenPoints& seen_b);

struct FreeSpaceParams {
  double resolution_m = 0.1;
  double end_margin_m = 0.3;  ///< the last part of a beam says nothing
  double max_range_m = 15.0;  ///< nor does what is farther away
  int min_beams = 3;          ///< through a cell that counts as free
  int min_points = 2;         ///< seen in a cell that counts as solid
  double solid_ratio = 0.5;   ///< and of points and beams in it, this share must be points: doors move, people walk
  std::size_t max_cells = 100'000'000;
};

/// What the beams of the map say about its cells: free where beams went through and no point was ever seen, neither in
/// the cell nor beside it; solid where they were stopped; passed where they went through, whatever was seen there once.
class FreeSpace {
 public:
  enum class State : std::uint8_t { kUnknown, kFree, kPassed, kSolid };

  explicit FreeSpace(const std::vector<SeenPoints>& seen_map, const FreeSpaceParams& params = {});
  [[nodiscard]] bool is_free(const Point2& p_map) const { return state(p_map) == State::kFree; }
  [[nodiscard]] bool is_solid(const Point2& p_map) const { return state(p_map) == State::kSolid; }
  /// What somebody saw here has gone, or came later: free space too.
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
  int solid = 140;             ///< likelihood of a cell that a beam does not get through (the field's sigma away)
  double step_m = 0.07;        ///< along the beam
  double near_m = 0.3;         ///< the robot's own surroundings are not looked at
  double end_margin_m = 0.35;  ///< nor is the end of the beam: rough poses and walls seen at an angle
  double max_range_m = 15.0;
  std::size_t max_beams = 180;  ///< of each scan
};

/// Shares of the beams, 0 to 1.
struct Agreement {
  double through = 0.0;  ///< pass through a solid surface of the map that faces them
  double in_free = 0.0;  ///< end in space that the map knows to be free: people, moved furniture, or a wrong place
  [[nodiscard]] double disagreement() const { return through + in_free; }
};

/// Of scans in the frame `base` with the base at map_T_base. Zero for no points.
[[nodiscard]] Agreement agreement_of(const LikelihoodPyramid& map, const FreeSpace& free_space,
                                     const std::vector<SeenPoints>& seen_base, const Pose2& map_T_base,
                                     const AgreementParams& params = {});

/// Mean likelihood of points at a pose, 0 to 1.
struct Fit {
  double all = 0.0;
  double standing = 0.0;  ///< without the points in free space: what does not move
};

/// Give it points thinned by cells, so that near walls do not outvote far ones. Zero for no points.
[[nodiscard]] Fit fit_of(const LikelihoodPyramid& map, const FreeSpace& free_space,
                         const std::vector<OrientedPoint>& points_base, const Pose2& map_T_base);

}  // namespace seeker::slam
