/// \file
/// Lines of a scan as observations of the SPmap (spec S1.4, steps 3-5): frame on the segment, ends real or virtual.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "server/lines/line.hpp"

namespace seeker::lines {

/// Which end of a segment. Facing the wall, left is at the larger bearing, at local x = -L/2 (spec S1.2).
enum Side : std::size_t { kLeft = 0, kRight = 1 };

/// One segment as seen from the robot. The segment's frame sits at the mid-point, x along the segment, y from free
/// space into the wall (spec S1.2): left end at x = -L/2, right end at +L/2.
struct SegmentObservation {
  Pose2 base_T_segment;
  double length_m = 0.0;
  std::array<bool, 2> real{};                   ///< by Side: a physical end (corner, door post), not a limit of sight
  Matrix2 covariance = Matrix2::Identity();     ///< of (p_y, p_theta): across the segment and its direction
  std::array<double, 2> end_sigma_m{0.0, 0.0};  ///< by Side: of p_e, independent of (p_y, p_theta)
  double beam_step_rad = 0.0;                   ///< between neighbouring beams; 0: ends do not depend on the beams
  /// A wall that ends within so far of foot_x_m, to either side, is seen to end there whichever beams meet it. Farther
  /// off only ends that happen to be read short of where they are count as real, and all of them would be short.
  double clear_m = std::numeric_limits<double>::infinity();
  double foot_x_m = 0.0;  ///< of the point of the line that is nearest to the laser, in the segment's frame
  int points = 0;
  std::size_t line = 0;  ///< index in ScanLines::lines
};

struct ObservationParams {
  double grazing_rad = 0.0873;      ///< lines seen at a smaller angle are left out (5 degrees, spec S1.4 step 3)
  double lost_rad = 0.1745;         ///< returns from surfaces at a smaller angle get lost: no end where there is none
  double end_spacing_m = 0.2;       ///< ends between beams that meet the line further apart than this are virtual
  double depth_step_m = 0.15;       ///< delta of step 4: nearer than the line by this = occluded, farther = wall ends
  double corner_gap_m = 0.15;       ///< another line begins within this of the end
  double corner_angle_rad = 0.349;  ///< and turns by more than this (20 degrees): a corner
  double range_margin_m = 0.05;     ///< ends nearer to the range limit than this are virtual
  double max_range_m = 0.0;         ///< limit of what is believed; 0: the scan's own
  /// Error of the walls, not of the laser: added to every observation, since real walls are not straight to a
  /// millimetre and neighbouring beams err together.
  double wall_sigma_m = 0.0;
  double wall_sigma_rad = 0.0;
};

/// Observations of one scan in the frame `base`, in the order of the lines they come from.
[[nodiscard]] std::vector<SegmentObservation> observe(const LaserScan& scan, const ScanLines& found,
                                                      const ObservationParams& params = {});

}  // namespace seeker::lines
