/// \file
/// Everything that can be set on the database localiser.
#pragma once

#include "common/core/angle.hpp"
#include "common/core/result.hpp"
#include "server/localize/association.hpp"
#include "server/localize/eye_filter.hpp"

namespace seeker::localize {

enum class FilterMode : std::uint8_t {
  kJoint,  ///< matches within the window of the prediction, outliers voted down, one iterated update
  kPaper,  ///< spec S2.5, S2.9: the whole database, gates, one measurement after the other
};

/// How features are taken for landmarks while the pose is known.
struct TrackingParams {
  double max_distance = 0.5;  ///< of descriptors
  double max_ratio = 0.9;     ///< best over second best among other landmarks of the window
  /// Of the innovation, 2 degrees of freedom, 99.99 %, and so wide is the window. What odometry errs by is in all
  /// innovations of a frame alike: at 99 % one frame in a hundred would lose all its matches. The vote finds the wrong
  /// ones.
  double gate_chi2 = 18.421;
  double window_sigmas = 3.0;        ///< of heights, and of distances between landmarks
  double min_window_px = 10.0;       ///< and at least this
  double height_tolerance_m = 0.10;  ///< between a landmark's height and the feature's: rocking, uneven floors
  double max_view_angle_rad = deg_to_rad(60.0);  ///< from where the landmark was seen before
  double vote_chi2 = 5.991;                      ///< of what agrees with one match, 2 degrees of freedom, 95 %
  int max_votes = 60;                            ///< matches that are asked

  friend bool operator==(const TrackingParams&, const TrackingParams&) = default;
};

/// Finding the place without knowing where to look.
struct RelocaliseParams {
  double max_distance = 0.45;    ///< of descriptors
  double ambiguity = 1.3;        ///< the second best landmark of a feature counts too, up to so many times the distance
  double max_scale_ratio = 1.5;  ///< between feature and landmark, either way
  int attempts = 6000;           ///< pairs of matches tried
  double min_separation_m = 0.3;  ///< of the two points of such a pair
  double gate_chi2 = 9.210;
  double height_tolerance_m = 0.10;
  int min_inliers = 8;
  /// Sum over the inliers of 1 - distance / max_distance. In rooms never surveyed up to 22 matches agreed by chance,
  /// but were hardly alike: 5.0 at most in 1000 views (`reproduce s2`).
  double min_likeness = 5.5;
  /// Or so many, and beside them a share of all matches: where most of what can agree does, it need not be alike (Brown
  /// and Lowe, Automatic Panoramic Image Stitching, 2007, eq 13).
  int many_inliers = 12;
  double many_share = 0.3;
  int min_cells = 4;  ///< of the picture's, with an inlier
  int cell_columns = 8;
  int cell_rows = 6;
  double min_lead = 1.5;                ///< inliers of the best place over those of the next one
  double rival_m = 0.5;                 ///< farther apart than this, or
  double rival_rad = deg_to_rad(10.0);  ///< turned by more, places are different
  double max_sigma_m = 0.25;  ///< a place less certain than this is none, nor one that is without any one match
  double confirm_m = 0.3;     ///< of a second frame that finds the place by itself: it must agree with the first within
  double confirm_rad = deg_to_rad(4.0);

  friend bool operator==(const RelocaliseParams&, const RelocaliseParams&) = default;
};

/// When the pose counts as known.
struct ConfidenceParams {
  int min_update_inliers = 4;  ///< fewer correct nothing
  int min_inliers = 8;         ///< fewer: DEGRADED
  int good_inliers = 40;       ///< quality 1 needs so many
  int window = 20;             ///< frames over which innovations are judged
  double degraded_nis = 1.8;   ///< mean squared innovation over its expectation
  double lost_nis = 3.0;
  int lost_after = 10;         ///< frames in a row below min_inliers
  int contradicted_after = 3;  ///< frames in a row with plenty of features and landmarks expected, and no agreement
  int plenty = 30;             ///< features in range, and landmarks expected, for that
  double lost_sigma_m = 0.5;   ///< coasting beyond this is being lost
  double lost_sigma_rad = deg_to_rad(12.0);
  int relocalise_after = 2;  ///< frames below min_update_inliers before the whole database is asked

  friend bool operator==(const ConfidenceParams&, const ConfidenceParams&) = default;
};

struct LocaliserParams {
  FilterMode mode = FilterMode::kJoint;
  vision::Metric metric = vision::Metric::kL2;
  LeverArm arm;
  double eye_height_m = 0.0;  ///< above the plane the database's heights are told from
  PixelNoise noise;
  RangeLimits range;
  MotionNoise motion;
  MeasurementNoise measurement;
  double landmark_sigma_floor_m = 0.003;    ///< a landmark is never more certain than this
  double disparity_offset_sigma_px = 0.2;   ///< error that all disparities share
  double disparity_offset_walk_px = 0.005;  ///< its change from frame to frame
  /// The same landmark seen again says nothing new about its own error: its covariance counts so many times over at
  /// most.
  int max_repeats = 30;
  /// What all landmarks err by together, from the poses of the survey: the pose is never told more certain.
  double map_sigma_m = 0.003;
  double map_sigma_rad = deg_to_rad(0.06);
  BatchParams batch;
  TrackingParams tracking;
  RelocaliseParams relocalise;
  ConfidenceParams confidence;

  friend bool operator==(const LocaliserParams&, const LocaliserParams&) = default;
};

/// Spec S2.8, S2.9 as printed.
[[nodiscard]] LocaliserParams paper_localiser_params();
/// kInvalidArgument with the field's name.
[[nodiscard]] Status validate(const LocaliserParams& params);

}  // namespace seeker::localize
