/// \file
/// All parameters of the database localiser.
#pragma once

#include "common/core/angle.hpp"
#include "common/core/result.hpp"
#include "server/localize/association.hpp"
#include "server/localize/eye_filter.hpp"

namespace seeker::localize {

enum class FilterMode : std::uint8_t {
  kJoint,  ///< matches within the window of the prediction, outliers rejected by votes, one iterated update
  kPaper,  ///< spec S2.5, S2.9: the whole database, gates, sequential updates
};

/// Association of features with landmarks while the pose is known.
struct TrackingParams {
  double max_distance = 0.5;  ///< largest distance of descriptors
  double max_ratio = 0.9;     ///< best distance over second best among the other landmarks of the window
  /// Gate of the innovation and size of the window, 2 degrees of freedom, 99.99 %. The error of the odometry is common
  /// to all innovations of a frame: at 99 % one frame in a hundred would lose all its matches. False matches are
  /// rejected by the votes.
  double gate_chi2 = 18.421;
  double window_sigmas = 3.0;        ///< window of heights, and of distances between landmarks
  double min_window_px = 10.0;       ///< lower limit of the window
  double height_tolerance_m = 0.10;  ///< between the heights of landmark and feature: rocking, uneven floors
  /// Largest angle from the directions in which the landmark was observed before.
  double max_view_angle_rad = deg_to_rad(60.0);
  double vote_chi2 = 5.991;  ///< gate for agreement with one match, 2 degrees of freedom, 95 %
  int max_votes = 60;        ///< number of matches that propose a correction

  friend bool operator==(const TrackingParams&, const TrackingParams&) = default;
};

/// Relocalisation without a known pose.
struct RelocaliseParams {
  double max_distance = 0.45;  ///< largest distance of descriptors
  /// Further landmarks of a feature are matched up to this ratio of distances to the best one.
  double ambiguity = 1.3;
  double max_scale_ratio = 1.5;   ///< largest ratio of the scales of feature and landmark, in either direction
  int attempts = 6000;            ///< number of pairs of matches tried
  double min_separation_m = 0.3;  ///< distance of the two points of such a pair
  double gate_chi2 = 9.210;
  double height_tolerance_m = 0.10;
  int min_inliers = 8;
  /// Sum over the inliers of 1 - distance / max_distance. In rooms never surveyed up to 22 matches agreed by chance,
  /// but with dissimilar descriptors: the sum was at most 5.0 in 1000 views (`reproduce s2`).
  double min_likeness = 5.5;
  /// Alternatively this number of inliers together with a share of all matches: where most of the possible matches
  /// agree, the descriptors may be dissimilar (Brown and Lowe, Automatic Panoramic Image Stitching, 2007, eq 13).
  int many_inliers = 12;
  double many_share = 0.3;
  int min_cells = 4;  ///< number of cells of the picture with an inlier
  int cell_columns = 8;
  int cell_rows = 6;
  double min_lead = 1.5;                ///< inliers of the best pose over those of the next one
  double rival_m = 0.5;                 ///< poses farther apart than this are different
  double rival_rad = deg_to_rad(10.0);  ///< and poses with a larger difference in heading
  double max_sigma_m = 0.25;  ///< largest standard deviation of a pose, with all matches and without any single one
  /// So many matches that agree, if no other place has nearly as many, are a guess: too few to believe, but the next
  /// frame may prove it by showing this share of the landmarks that are expected there.
  int guess_inliers = 5;
  double guess_share = 0.25;
  double confirm_m = 0.3;  ///< largest difference from the pose that a second frame finds independently
  double confirm_rad = deg_to_rad(4.0);

  friend bool operator==(const RelocaliseParams&, const RelocaliseParams&) = default;
};

/// When the pose counts as known.
struct ConfidenceParams {
  int min_update_inliers = 4;  ///< number of inliers below which no correction is made
  int min_inliers = 8;         ///< number of inliers below which the quality is DEGRADED
  int good_inliers = 40;       ///< number of inliers for confidence 1
  int window = 20;             ///< number of frames over which innovations are judged
  double degraded_nis = 1.8;   ///< mean squared innovation over its expectation
  double lost_nis = 3.0;
  int lost_after = 10;  ///< number of frames in a row below min_inliers
  /// Number of frames in a row with plenty of features and expected landmarks but no agreement.
  int contradicted_after = 3;
  int plenty = 30;            ///< number of features in range, and of expected landmarks, for that
  double lost_sigma_m = 0.5;  ///< standard deviation by dead reckoning above which the robot is LOST
  double lost_sigma_rad = deg_to_rad(12.0);
  /// Number of frames below min_update_inliers after which the whole database is searched.
  int relocalise_after = 2;

  friend bool operator==(const ConfidenceParams&, const ConfidenceParams&) = default;
};

struct LocaliserParams {
  FilterMode mode = FilterMode::kJoint;
  vision::Metric metric = vision::Metric::kL2;
  /// As AssociationParams::bbf_leaves, wherever the whole database is searched.
  int bbf_leaves = 0;
  LeverArm arm;
  double eye_height_m = 0.0;  ///< height above the reference plane of the database
  PixelNoise noise;
  RangeLimits range;
  MotionNoise motion;
  MeasurementNoise measurement;
  double landmark_sigma_floor_m = 0.003;    ///< lower limit of the standard deviation of a landmark
  double disparity_offset_sigma_px = 0.2;   ///< standard deviation of the common error of all disparities
  double disparity_offset_walk_px = 0.005;  ///< random walk of this error from frame to frame
  /// Repeated observations of a landmark hold no new information about its own error: its covariance is counted at most
  /// this many times.
  int max_repeats = 30;
  /// Common error of all landmarks, from the poses of the survey: a lower limit of the reported standard deviation.
  double map_sigma_m = 0.003;
  double map_sigma_rad = deg_to_rad(0.06);
  BatchParams batch;
  TrackingParams tracking;
  RelocaliseParams relocalise;
  ConfidenceParams confidence;

  friend bool operator==(const LocaliserParams&, const LocaliserParams&) = default;
};

/// The parameters of spec S2.8, S2.9 as printed.
[[nodiscard]] LocaliserParams paper_localiser_params();
/// Fails with kInvalidArgument and the field's name.
[[nodiscard]] Status validate(const LocaliserParams& params);

}  // namespace seeker::localize
