#include "server/localize/survey.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "common/core/assert.hpp"

namespace seeker::localize {

DatabaseParams paper_database_params() {
  DatabaseParams params;
  params.noise.separate_eyes = true;
  params.range.min_m = kPaperMinRange_m;
  params.association.metric = vision::Metric::kL1;
  params.association.max_distance = 2.5;
  params.association.anywhere = true;
  params.association.bbf_leaves = vision::kPaperLeaves;
  params.sparsity.inner_radius_m = 0.10;
  params.sparsity.outer_radius_m = 0.50;
  params.sparsity.min_distance = 2.5;
  params.sparsity.best_first = false;
  params.fusion.running_mean = true;
  params.adjustment.on = false;
  return params;
}

Status validate(const DatabaseParams& params) {
  const auto bad = [](const char* what) { return fail(Errc::kInvalidArgument, what); };
  const auto positive = [](double value) { return std::isfinite(value) && value > 0.0; };
  if (!positive(params.noise.sigma_px) || !positive(params.noise.sigma_disparity_px)) {
    return bad("noise.sigma_px and noise.sigma_disparity_px must be above zero");
  }
  if (!positive(params.range.min_m) || !(params.range.max_m > params.range.min_m) ||
      !std::isfinite(params.range.max_m)) {
    return bad("range.min_m must be above zero and range.max_m above it");
  }
  const AssociationParams& pairs = params.association;
  if (!positive(pairs.max_distance) || !positive(pairs.gate_chi2) || !(pairs.min_offset_m >= 0.0) ||
      !(pairs.max_offset_m >= pairs.min_offset_m) || !std::isfinite(pairs.max_offset_m)) {
    return bad("association: distances, gate and offsets must be above zero, max_offset_m at least min_offset_m");
  }
  const SparsityParams& sparsity = params.sparsity;
  if (!(sparsity.inner_radius_m >= 0.0) || !(sparsity.outer_radius_m >= sparsity.inner_radius_m) ||
      !std::isfinite(sparsity.outer_radius_m) || !(sparsity.min_distance >= 0.0)) {
    return bad("sparsity: outer_radius_m must be at least inner_radius_m, and that at least zero");
  }
  if (!(params.fusion.view_cluster_rad > 0.0)) {
    return bad("fusion.view_cluster_deg must be above zero");
  }
  const AdjustmentParams& adjustment = params.adjustment;
  if (adjustment.rounds < 1 || adjustment.iterations < 1 || !positive(adjustment.huber_sigmas) ||
      !positive(adjustment.point_sigma_m) || !positive(adjustment.offset_sigma_px)) {
    return bad("adjustment: rounds and iterations must be at least 1, huber_sigmas and the sigmas above zero");
  }
  if (pairs.bbf_leaves < 0) {
    return bad("association.bbf_leaves must be at least 0");
  }
  return params.salient_seen >= 1 ? Status() : bad("salient_seen must be at least 1");
}

std::string_view to_string(FeatureFate fate) {
  switch (fate) {
    case FeatureFate::kOutOfRange: return "out-of-range";
    case FeatureFate::kMatched: return "matched";
    case FeatureFate::kSparsified: return "sparsified";
    case FeatureFate::kInserted: return "inserted";
  }
  SEEKER_ASSERT(false);
  return "";
}

Status check_pose(const Sighting& sighting) {
  const bool finite =
      is_finite(sighting.map_T_eye) && std::isfinite(sighting.eye_height_m) && sighting.pose_covariance.allFinite();
  if (!finite) {
    return fail(Errc::kInvalidArgument, "the pose of a sighting is not finite; check where it comes from");
  }
  // Landmarks lie a few metres from the eye and must stay in range, too.
  constexpr double kMaxEye_m = kMaxCoordinate_m / 2.0;
  const double farthest_m =
      std::max({std::abs(sighting.map_T_eye.x_m), std::abs(sighting.map_T_eye.y_m), std::abs(sighting.eye_height_m)});
  if (farthest_m > kMaxEye_m) {
    return fail(Errc::kInvalidArgument, "the pose of a sighting lies " + std::to_string(farthest_m) +
                                            " m from the origin, over the limit of " + std::to_string(kMaxEye_m) +
                                            "; use an origin in the building");
  }
  if (sighting.pose_covariance.diagonal().minCoeff() < 0.0) {
    return fail(Errc::kInvalidArgument, "the covariance of a sighting's pose has a negative variance");
  }
  return {};
}

SurveyBuilder::SurveyBuilder(const StereoGeometry& geometry, const DatabaseParams& params)
    : geometry_(geometry), params_(params), database_(calibration_hash(geometry)) {
  SEEKER_ASSERT(validate(geometry).has_value() && validate(params).has_value());
}

Result<SightingCounts> SurveyBuilder::add(const Sighting& sighting) {
  if (const Status ok = check_pose(sighting); !ok) {
    return tl::unexpected(ok.error());
  }
  const std::vector<SeenPoint> points = see(geometry_, sighting, params_.noise, params_.range);
  const std::vector<Pairing> pairs = associate(database_, sighting.features, points, params_.association);
  const std::uint64_t number = database_.begin_sighting();
  fates_.assign(sighting.features.size(), FeatureFate::kOutOfRange);
  landmarks_.assign(sighting.features.size(), 0);
  std::vector<bool> paired(points.size(), false);
  for (const Pairing& pair : pairs) {
    const SeenPoint& point = points[pair.point];
    paired[pair.point] = true;
    fates_[point.feature] = FeatureFate::kMatched;
    landmarks_[point.feature] = database_.at(pair.landmark).id;
    database_.change(pair.landmark, [&](Landmark& landmark) {
      fuse(landmark, point, sighting.features[point.feature].descriptor, params_.fusion);
      landmark.last_seen = number;
    });
  }
  SightingCounts counts{static_cast<int>(sighting.features.size()), static_cast<int>(points.size()),
                        static_cast<int>(pairs.size()), 0, 0};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const vision::Descriptor& descriptor = sighting.features[points[i].feature].descriptor;
    if (paired[i]) {
      continue;
    }
    const bool is_new = params_.sparsity.best_first ||
                        may_insert(database_, points[i], descriptor, params_.sparsity, params_.association.metric);
    fates_[points[i].feature] = is_new ? FeatureFate::kInserted : FeatureFate::kSparsified;
    ++(is_new ? counts.inserted : counts.sparsified);
    if (is_new) {
      Landmark landmark = make_landmark(points[i], descriptor);
      landmark.last_seen = number;
      landmarks_[points[i].feature] = database_.insert(std::move(landmark));
    }
  }
  return counts;
}

LandmarkDatabase SurveyBuilder::salient() const {
  LandmarkDatabase kept = database_;
  kept.erase_if([this](const Landmark& landmark) { return landmark.seen < params_.salient_seen; });
  if (params_.sparsity.best_first) {
    thin_out(kept, params_.sparsity, params_.association.metric);
  }
  return kept;
}

void SurveyBuilder::clear() {
  database_.erase_if([](const Landmark&) { return true; });
  fates_.clear();
  landmarks_.clear();
}

}  // namespace seeker::localize
