#include "server/localize/localiser_params.hpp"

#include <cmath>
#include <initializer_list>
#include <limits>
#include <string>

namespace seeker::localize {
namespace {

struct Bound {
  const char* name;
  double value;
  double least;  ///< inclusive
};

/// kInvalidArgument with the name of the first value below its bound or not finite.
Status at_least(std::initializer_list<Bound> bounds) {
  for (const Bound& bound : bounds) {
    if (!std::isfinite(bound.value) || bound.value < bound.least) {
      return fail(Errc::kInvalidArgument, std::string(bound.name) + " must be at least " + std::to_string(bound.least));
    }
  }
  return {};
}

constexpr double kLeast = 1e-6;  ///< for what must be above zero

Status check_filter(const LocaliserParams& p) {
  return at_least({{"bbf_leaves", static_cast<double>(p.bbf_leaves), 0.0},
                   {"noise.sigma_px", p.noise.sigma_px, kLeast},
                   {"noise.sigma_disparity_px", p.noise.sigma_disparity_px, kLeast},
                   {"range.min_m", p.range.min_m, kLeast},
                   {"range.max_m", p.range.max_m, p.range.min_m + kLeast},
                   {"motion.v_share", p.motion.v_share, 0.0},
                   {"motion.v_floor_m_s", p.motion.v_floor_m_s, 0.0},
                   {"motion.omega_share", p.motion.omega_share, 0.0},
                   {"motion.omega_floor_rad_s", p.motion.omega_floor_rad_s, 0.0},
                   {"motion.drift_per_m", p.motion.drift_per_m, 0.0},
                   {"motion.across_share", p.motion.across_share, 0.0},
                   {"motion.variance_floor", p.motion.variance_floor, 0.0},
                   {"measurement.range_floor_m", p.measurement.range_floor_m, 0.0},
                   {"measurement.bearing_floor_deg", p.measurement.bearing_floor_rad, 0.0},
                   {"landmark_sigma_floor_m", p.landmark_sigma_floor_m, 0.0},
                   {"disparity_offset_sigma_px", p.disparity_offset_sigma_px, 0.0},
                   {"disparity_offset_walk_px", p.disparity_offset_walk_px, 0.0},
                   {"map_sigma_m", p.map_sigma_m, 0.0},
                   {"map_sigma_deg", p.map_sigma_rad, 0.0},
                   {"max_repeats", static_cast<double>(p.max_repeats), 1.0},
                   {"batch.iterations", static_cast<double>(p.batch.iterations), 1.0},
                   {"batch.huber_sigmas", p.batch.huber_sigmas, kLeast}});
}

Status check_matching(const LocaliserParams& p) {
  return at_least({{"tracking.max_distance", p.tracking.max_distance, kLeast},
                   {"tracking.max_ratio", p.tracking.max_ratio, kLeast},
                   {"tracking.gate_chi2", p.tracking.gate_chi2, kLeast},
                   {"tracking.window_sigmas", p.tracking.window_sigmas, kLeast},
                   {"tracking.min_window_px", p.tracking.min_window_px, 1.0},
                   {"tracking.height_tolerance_m", p.tracking.height_tolerance_m, 0.0},
                   {"tracking.max_view_angle_deg", p.tracking.max_view_angle_rad, kLeast},
                   {"tracking.vote_chi2", p.tracking.vote_chi2, kLeast},
                   {"tracking.max_votes", static_cast<double>(p.tracking.max_votes), 1.0},
                   {"relocalise.max_distance", p.relocalise.max_distance, kLeast},
                   {"relocalise.ambiguity", p.relocalise.ambiguity, 1.0},
                   {"relocalise.max_scale_ratio", p.relocalise.max_scale_ratio, 1.0},
                   {"relocalise.attempts", static_cast<double>(p.relocalise.attempts), 1.0},
                   {"relocalise.min_separation_m", p.relocalise.min_separation_m, kLeast},
                   {"relocalise.gate_chi2", p.relocalise.gate_chi2, kLeast},
                   {"relocalise.height_tolerance_m", p.relocalise.height_tolerance_m, 0.0},
                   {"relocalise.min_inliers", static_cast<double>(p.relocalise.min_inliers), 3.0},
                   {"relocalise.guess_inliers", static_cast<double>(p.relocalise.guess_inliers), 3.0},
                   {"relocalise.guess_share", p.relocalise.guess_share, 0.0},
                   {"relocalise.min_likeness", p.relocalise.min_likeness, 0.0},
                   {"relocalise.many_inliers", static_cast<double>(p.relocalise.many_inliers), 3.0},
                   {"relocalise.many_share", p.relocalise.many_share, 0.0},
                   {"relocalise.min_cells", static_cast<double>(p.relocalise.min_cells), 1.0},
                   {"relocalise.cell_columns", static_cast<double>(p.relocalise.cell_columns), 1.0},
                   {"relocalise.cell_rows", static_cast<double>(p.relocalise.cell_rows), 1.0},
                   {"relocalise.min_lead", p.relocalise.min_lead, 1.0},
                   {"relocalise.rival_m", p.relocalise.rival_m, kLeast},
                   {"relocalise.rival_deg", p.relocalise.rival_rad, kLeast},
                   {"relocalise.max_sigma_m", p.relocalise.max_sigma_m, kLeast},
                   {"relocalise.confirm_m", p.relocalise.confirm_m, kLeast},
                   {"relocalise.confirm_deg", p.relocalise.confirm_rad, kLeast}});
}

Status check_confidence(const ConfidenceParams& p) {
  return at_least(
      {{"confidence.min_update_inliers", static_cast<double>(p.min_update_inliers), 1.0},
       {"confidence.min_inliers", static_cast<double>(p.min_inliers), static_cast<double>(p.min_update_inliers)},
       {"confidence.good_inliers", static_cast<double>(p.good_inliers), static_cast<double>(p.min_inliers)},
       {"confidence.window", static_cast<double>(p.window), 1.0},
       {"confidence.degraded_nis", p.degraded_nis, kLeast},
       {"confidence.lost_nis", p.lost_nis, p.degraded_nis},
       {"confidence.lost_after", static_cast<double>(p.lost_after), 1.0},
       {"confidence.contradicted_after", static_cast<double>(p.contradicted_after), 1.0},
       {"confidence.plenty", static_cast<double>(p.plenty), 1.0},
       {"confidence.lost_sigma_m", p.lost_sigma_m, kLeast},
       {"confidence.lost_sigma_deg", p.lost_sigma_rad, kLeast},
       {"confidence.relocalise_after", static_cast<double>(p.relocalise_after), 1.0}});
}

}  // namespace

LocaliserParams paper_localiser_params() {
  LocaliserParams params;
  params.mode = FilterMode::kPaper;
  params.metric = vision::Metric::kL1;
  params.bbf_leaves = vision::kPaperLeaves;
  params.range.min_m = kPaperMinRange_m;
  params.noise.separate_eyes = true;
  params.measurement = {.range_floor_m = 0.02, .bearing_floor_rad = 0.005, .landmark_covariance = false};
  params.disparity_offset_sigma_px = 0.0;
  params.disparity_offset_walk_px = 0.0;
  params.map_sigma_m = 0.0;
  params.map_sigma_rad = 0.0;
  params.tracking.max_distance = 2.5;
  params.tracking.gate_chi2 = 9.210;
  params.relocalise.max_distance = 2.5;
  params.relocalise.guess_inliers = std::numeric_limits<int>::max();  // the paper knows no guesses
  return params;
}

Status validate(const LocaliserParams& params) {
  if (!std::isfinite(params.eye_height_m) || !is_finite(params.arm.base_T_eye())) {
    return fail(Errc::kInvalidArgument, "eye_height_m and arm must be finite");
  }
  for (const Status& ok : {check_filter(params), check_matching(params), check_confidence(params.confidence)}) {
    if (!ok) {
      return ok;
    }
  }
  return {};
}

}  // namespace seeker::localize
