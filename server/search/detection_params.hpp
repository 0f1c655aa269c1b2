/// \file
/// Parameters of sighting fusion.
#pragma once

#include "common/core/angle.hpp"
#include "common/core/pose2.hpp"

namespace seeker::search {

struct DetectionParams {
  Pose2 base_T_camera;                         ///< mirror axis (or optical centre) on the base
  double bearing_sigma_rad = deg_to_rad(1.5);  ///< camera alignment error 1-2 deg (spec S3.5)
  double sonar_sigma_m = 0.10;                 ///< standard deviation of an interpolated sonar range
  double lidar_sigma_m = 0.03;
  double floor_sigma_m = 0.08;  ///< standard deviation of a range from the camera's height, to the middle of the object
  double sonar_max_range_m = 3.0;  ///< farther sonar ranges are not used
  /// Above 0: echoes lie on the axes of the transducers, at a distance from the robot's centre of this radius and the
  /// reading, as eqs (2) and (3) of spec S3.3 put them; 0: where the mounts of the transducers put them.
  double sonar_radius_m = 0.0;
  double lidar_max_range_m = 8.0;
  double lidar_window_rad = deg_to_rad(2.0);  ///< half width of the bundle around the bearing
  /// A range that differs by more than this share from the sighting's own hint (apparent size) belongs to another
  /// object and is not used.
  double size_range_factor = 0.5;
  double depth_sigma_m = 0.04;                 ///< standard deviation of the unknown place on the target's surface
  double min_parallax_rad = deg_to_rad(10.0);  ///< bearings alone triangulate above this angle
  double gate_position = 9.21;                 ///< chi2, 2 dof, 99 %
  double gate_bearing = 6.63;                  ///< chi2, 1 dof, 99 %
  double new_place_m = 0.3;                    ///< a sighting from farther away than this is from another place
  int confirm_places = 2;  ///< number of places that must have seen it; 1: the first sighting counts
  /// Whether a track must have a position, too: to see something again in the same direction may be to make the same
  /// mistake again.
  bool confirm_position = true;
  double sure_score = 0.95;  ///< a score at or above confirms at once
  int max_misses = 3;        ///< misses beyond the number of sightings that refute a track
  /// An observation without the target counts as a miss where the hit rate is at least this.
  double miss_probability = 0.5;
  /// A sighting with a lower score is doubtful: the search goes on, and its next pictures decide. It is refuted when a
  /// target at its place would have stayed unseen in all of them with a probability below doubtful_unseen.
  double doubtful_score = 0.8;
  double doubtful_unseen = 0.2;
  double max_bearing_range_m = 8.0;  ///< intersections of bearings farther away are rejected

  [[nodiscard]] bool doubtful(double score) const { return score < doubtful_score; }
};

}  // namespace seeker::search
