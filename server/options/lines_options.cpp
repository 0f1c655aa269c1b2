#include "server/options/lines_options.hpp"

namespace seeker::lines {

void describe(config::Fields& f, NoiseParams& params) {
  f.field("sigma_m", params.sigma_m);
  f.field("slope", params.slope);
  f.field("nominal_sigma_m", params.nominal_sigma_m);
  f.field("min_sigma_m", params.min_sigma_m);
  f.field("max_sigma_m", params.max_sigma_m);
  f.field("min_samples", params.min_samples);
  f.field("slope_significance", params.slope_significance);
  f.check("sigma_m", params.sigma_m >= 0.0, "must not be negative; 0 estimates the noise from each scan");
  f.check("nominal_sigma_m", params.nominal_sigma_m > 0.0, "must be positive");
  f.check("min_sigma_m", params.min_sigma_m > 0.0 && params.min_sigma_m <= params.max_sigma_m,
          "must be positive and not above max_sigma_m");
}

void describe(config::Fields& f, FastParams& params) {
  f.section("noise", params.noise);
  f.angle_deg("bearing_sigma_deg", params.bearing_sigma_rad);
  f.field("straightness_m", params.straightness_m);
  f.field("max_gap_m", params.max_gap_m);
  f.field("max_gap_spacings", params.max_gap_spacings);
  f.field("in_line_sigmas", params.in_line_sigmas);
  f.field("max_missing_beams", params.max_missing_beams);
  f.field("split_sigmas", params.split_sigmas);
  f.field("excess_sigmas", params.excess_sigmas);
  f.field("merge_sigmas", params.merge_sigmas);
  f.field("split_chi2", params.split_chi2);
  f.field("max_merge_gap_m", params.max_merge_gap_m);
  f.field("corner_sigmas", params.corner_sigmas);
  f.field("corner_doubt", params.corner_doubt);
  f.field("inflation_sigmas", params.inflation_sigmas);
  f.field("max_outliers", params.max_outliers);
  f.field("min_points", params.min_points);
  f.field("min_length_m", params.min_length_m);
  f.field("min_range_m", params.min_range_m);
  f.field("max_range_m", params.max_range_m);
  f.check("min_points", params.min_points >= 4, "a line has at least 4 points");
  f.check("corner_sigmas", params.corner_sigmas >= 0.0, "must not be negative");
  f.check("corner_doubt", params.corner_doubt >= 0.0, "must not be negative");
  f.check("split_sigmas", params.split_sigmas > 0.0, "must be positive");
}

void describe(config::Fields& f, ObservationParams& params) {
  f.angle_deg("grazing_deg", params.grazing_rad);
  f.angle_deg("lost_deg", params.lost_rad);
  f.field("end_spacing_m", params.end_spacing_m);
  f.field("depth_step_m", params.depth_step_m);
  f.field("corner_gap_m", params.corner_gap_m);
  f.angle_deg("corner_angle_deg", params.corner_angle_rad);
  f.field("range_margin_m", params.range_margin_m);
  f.field("max_range_m", params.max_range_m);
  f.field("wall_sigma_m", params.wall_sigma_m);
  f.angle_deg("wall_sigma_deg", params.wall_sigma_rad);
  f.check("grazing_deg", params.grazing_rad > 0.0, "must be positive");
  f.check("lost_deg", params.lost_rad >= 0.0, "must not be negative");
  f.check("end_spacing_m", params.end_spacing_m > 0.0, "must be positive");
}

void describe(config::Fields& f, LineThresholds& params) {
  f.field("gap_m", params.gap_m);
  f.field("corner_m", params.corner_m);
  f.check("gap_m", params.gap_m > 0.0, "must be positive");
  f.check("corner_m", params.corner_m > 0.0, "must be positive");
}

void describe(config::Fields& f, PaperParams& params) {
  f.section("start", params.start);
  f.section("noise", params.noise);
  f.angle_deg("bearing_sigma_deg", params.bearing_sigma_rad);
  f.field("seed_points", params.seed_points);
  f.field("look_ahead", params.look_ahead);
  f.field("max_fit_error_m", params.max_fit_error_m);
  f.field("fit_error_sigmas", params.fit_error_sigmas);
  f.field("corner_sigmas", params.corner_sigmas);
  f.field("shrink", params.shrink);
  f.field("max_rounds", params.max_rounds);
  f.field("min_gap_spacings", params.min_gap_spacings);
  f.field("min_corner_m", params.min_corner_m);
  f.field("min_points", params.min_points);
  f.field("min_length_m", params.min_length_m);
  f.field("merge_distance", params.merge_distance);
  f.field("merge_gap_m", params.merge_gap_m);
  f.check("seed_points", params.seed_points >= 2, "a seed has at least 2 points");
  f.check("shrink", params.shrink > 0.0 && params.shrink < 1.0, "must lie between 0 and 1");
}

void describe(config::Fields& f, RegressionParams& params) {
  f.section("noise", params.noise);
  f.angle_deg("bearing_sigma_deg", params.bearing_sigma_rad);
  f.field("min_range_m", params.min_range_m);
  f.field("max_range_m", params.max_range_m);
  f.field("max_gap_m", params.max_gap_m);
  f.field("max_gap_spacings", params.max_gap_spacings);
  f.field("max_missing_beams", params.max_missing_beams);
  f.field("min_group", params.min_group);
  f.field("window_points", params.window_points);
  f.field("max_fidelity", params.max_fidelity);
  f.field("merge_chi2", params.merge_chi2);
  f.field("merge_gap_m", params.merge_gap_m);
  f.field("outlier_sigmas", params.outlier_sigmas);
  f.field("min_points", params.min_points);
  f.field("min_length_m", params.min_length_m);
  f.check("window_points", params.window_points >= 3, "a window has at least 3 points");
  f.check("min_group", params.min_group >= 3, "a group has at least 3 points");
  f.check("max_fidelity", params.max_fidelity > 0.0, "must be positive");
  f.check("outlier_sigmas", params.outlier_sigmas > 0.0, "must be positive");
}

void describe(config::Fields& f, SplitParams& params) {
  f.section("noise", params.noise);
  f.angle_deg("bearing_sigma_deg", params.bearing_sigma_rad);
  f.field("gap_m", params.gap_m);
  f.field("split_m", params.split_m);
  f.field("merge_gap_m", params.merge_gap_m);
  f.field("min_points", params.min_points);
  f.field("min_length_m", params.min_length_m);
  f.check("gap_m", params.gap_m > 0.0, "must be positive");
  f.check("split_m", params.split_m > 0.0, "must be positive");
}

void describe(config::Fields& f, ExtractorParams& params) {
  f.choice("extractor", params.kind, config::choices_of(kExtractorKinds));
  f.section("fast", params.fast);
  f.section("five_modes", params.five_modes);
  f.section("regression", params.regression);
  f.section("split", params.split);
}

}  // namespace seeker::lines
