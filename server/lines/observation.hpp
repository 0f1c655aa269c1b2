/// \file
/// Lines of a scan as observations of the SPmap (spec S1.4, steps 3-5): frame on the segment, ends real or virtual.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "server/lines/line.hpp"

namespace seeker::lines {

/// The end of a segment. Facing the wall, left is at the larger bearing, at local x = -L/2 (spec S1.2).
enum Side : std::size_t { kLeft = 0, kRight = 1 };

/// One segment as observed by the robot. The segment's frame is at the mid-point, x along the segment, y from free
/// space into the wall (spec S1.2): left end at x = -L/2, right end at +L/2.
struct SegmentObservation {
  Pose2 base_T_segment;
  double length_m = 0.0;
  std::array<bool, 2> real{};  ///< by Side: a physical end (corner, door post), not a limit of the view
  /// Covariance of (p_y, p_theta): offset across the segment and its direction.
  Matrix2 covariance = Matrix2::Identity();
  /// By Side: standard deviation of p_e, independent of (p_y, p_theta).
  std::array<double, 2> end_sigma_m{0.0, 0.0};
  double beam_step_rad = 0.0;  ///< angle between neighbouring beams; 0: ends do not depend on the beams
  /// An end within this distance of foot_x_m, to either side, is observed correctly by any beams. Beyond it only ends
  /// that are measured short of their true position count as real, so that all of them would be biased.
  double clear_m = std::numeric_limits<double>::infinity();
  double foot_x_m = 0.0;  ///< position of the line's point nearest to the laser, in the segment's frame
  int points = 0;
  std::size_t line = 0;  ///< index in ScanLines::lines
};

struct ObservationParams {
  /// Lines at a smaller angle to the beams are left out (5 degrees, spec S1.4 step 3).
  double grazing_rad = 0.0873;
  /// Surfaces at a smaller angle may lose their returns: an end without returns beyond it is virtual.
  double lost_rad = 0.1745;
  double end_spacing_m = 0.2;  ///< ends between beams that meet the line farther apart than this are virtual
  /// Delta of step 4: nearer than the line by this is occluded, farther means that the wall ends.
  double depth_step_m = 0.15;
  double corner_gap_m = 0.15;       ///< distance from the end within which another line begins at a corner
  double corner_angle_rad = 0.349;  ///< smallest angle between the two lines of a corner (20 degrees)
  double range_margin_m = 0.05;     ///< ends closer to the range limit than this are virtual
  double max_range_m = 0.0;         ///< range limit; 0: the scan's own
  /// Standard deviation of the walls, not of the laser: added to every observation, since real walls are not straight
  /// to a millimetre and neighbouring beams have correlated errors.
  double wall_sigma_m = 0.0;
  double wall_sigma_rad = 0.0;
};

/// Observations of one scan in the frame `base`, in the order of their lines.
[[nodiscard]] std::vector<SegmentObservation> observe(const LaserScan& scan, const ScanLines& found,
                                                      const ObservationParams& params = {});

}  // namespace seeker::lines
