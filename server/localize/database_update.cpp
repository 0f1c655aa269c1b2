#include "server/localize/database_update.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <unordered_set>
#include <utility>

#include "common/core/assert.hpp"
#include "server/localize/survey_adjustment.hpp"

namespace seeker::localize {
namespace {

/// As many as a survey has are made to agree at a time: it takes time with the cube of their number, and each holds all
/// its features.
constexpr std::size_t kMostFrames = 100;

/// For about so many frames of a drive a landmark stays in view.
constexpr double kFramesOfALandmark = 10.0;

}  // namespace

UpdateParams paper_update_params() {
  UpdateParams params;
  params.database = paper_database_params();
  params.count_misses = true;
  params.min_move_m = 0.0;
  params.min_rotation_rad = 0.0;
  params.max_teaching_sigma_m = 0.0;
  return params;
}

Status validate(const UpdateParams& params) {
  if (Status ok = validate(params.database); !ok) {
    return ok;
  }
  const auto bad = [](const char* what) { return fail(Errc::kInvalidArgument, what); };
  if (params.max_misses < 1) {
    return bad("max_misses must be at least 1");
  }
  if (!(params.seen_gone > 0.0 && params.seen_there > params.seen_gone && params.seen_there < 1.0)) {
    return bad("seen_gone must be above 0, seen_there above it and below 1");
  }
  if (!(params.remove_log_odds < 0.0) || !(params.max_log_odds > 0.0) || !std::isfinite(params.remove_log_odds) ||
      !std::isfinite(params.max_log_odds)) {
    return bad("remove_log_odds must be below 0 and max_log_odds above");
  }
  if (!(params.occlusion_px >= 0.0) || !(params.occlusion_ratio >= 1.0)) {
    return bad("occlusion_px must be at least 0 and occlusion_ratio at least 1");
  }
  if (!(params.min_move_m >= 0.0) || !(params.min_rotation_rad >= 0.0)) {
    return bad("min_move_m and min_rotation_deg must be at least 0");
  }
  if (!(params.max_teaching_sigma_m >= 0.0)) {
    return bad("max_teaching_sigma_m must be at least 0");
  }
  return params.max_removed_share > 0.0 && params.max_removed_share <= 1.0
             ? Status()
             : bad("max_removed_share must be above 0 and at most 1");
}

DatabaseUpdate::DatabaseUpdate(const StereoGeometry& geometry, const UpdateParams& params)
    : geometry_(geometry), params_(params), dynamic_(geometry, params.database) {
  SEEKER_ASSERT(validate(params).has_value());
}

bool DatabaseUpdate::moved(const Pose2& map_T_eye) const {
  return !last_eye_ || distance_m(*last_eye_, map_T_eye) >= params_.min_move_m ||
         std::abs(wrap_angle(last_eye_->theta_rad - map_T_eye.theta_rad)) >= params_.min_rotation_rad;
}

/// True where a nearer object is around the landmark's position in the picture.
bool DatabaseUpdate::hidden(const Landmark& landmark, const Sighting& sighting) const {
  const auto pixel = project(geometry_, to_eye(sighting.map_T_eye, sighting.eye_height_m, landmark.p_map));
  if (!pixel) {
    return true;
  }
  return std::any_of(sighting.features.begin(), sighting.features.end(), [&](const vision::StereoFeature& feature) {
    const double aside_px = std::hypot(feature.left.u_px - pixel->u_px, feature.left.v_px - pixel->v_px);
    return aside_px <= params_.occlusion_px && feature.disparity_px > params_.occlusion_ratio * pixel->disparity_px;
  });
}

void DatabaseUpdate::tally(const LandmarkDatabase& database, const Sighting& sighting, const LocaliserStep& step) {
  std::unordered_set<LandmarkId> hits;
  for (const FrameMatch& match : step.inliers) {
    hits.insert(match.landmark);
  }
  for (const LandmarkId id : step.expected) {
    const Landmark* landmark = database.find(id);
    const bool hit = hits.contains(id);
    // The paper knows no occlusion.
    if (landmark == nullptr || (!hit && !params_.count_misses && hidden(*landmark, sighting))) {
      continue;
    }
    const auto [found, is_new] = tallies_.try_emplace(id, Tally{0, 0, landmark->misses, landmark->log_odds});
    Tally& tally = found->second;
    ++tally.expected;
    tally.hits += hit ? 1 : 0;
    tally.misses = hit ? 0 : tally.misses + 1;
    tally.log_odds += hit ? std::log(params_.seen_there / params_.seen_gone)
                          : std::log((1.0 - params_.seen_there) / (1.0 - params_.seen_gone));
    // Once it is given up it stays so until the update is made: bounded below, too.
    tally.log_odds = std::clamp(tally.log_odds, params_.remove_log_odds, params_.max_log_odds);
  }
}

bool DatabaseUpdate::observe(const LandmarkDatabase& database, const Sighting& sighting, const LocaliserStep& step) {
  if (step.relocalised) {
    last_T_eye_.reset();  // it may have been carried
  } else if (last_T_eye_) {
    last_T_eye_ = compose(*last_T_eye_, step.last_T_eye);
  }
  if (step.quality != LocalisationQuality::kLocalised || !step.corrected || !moved(sighting.map_T_eye)) {
    return false;
  }
  if (!check_pose(sighting)) {
    return false;
  }
  recent_.push_back({sighting, step.inliers, std::exchange(last_T_eye_, UncertainPose{})});
  if (recent_.size() >= kMostFrames && !learn(database, std::exchange(recent_, {}), dynamic_)) {
    return false;
  }
  last_eye_ = sighting.map_T_eye;
  ++frames_;
  tally(database, sighting, step);
  return true;
}

bool DatabaseUpdate::full() const { return params_.database.adjustment.on && recent_.size() + 1 >= kMostFrames; }

bool DatabaseUpdate::is_gone(const Landmark& landmark) const {
  return params_.count_misses ? landmark.misses >= params_.max_misses : landmark.log_odds <= params_.remove_log_odds;
}

void DatabaseUpdate::apply_tallies(LandmarkDatabase& database) const {
  for (int i = 0; i < frames_; ++i) {
    database.begin_sighting();
  }
  for (std::size_t i = 0; i < database.size(); ++i) {
    const auto found = tallies_.find(database.at(i).id);
    if (found == tallies_.end()) {
      continue;
    }
    const Tally& tally = found->second;
    database.change(i, [&](Landmark& landmark) {
      landmark.seen += tally.hits;
      landmark.expected += tally.expected;
      landmark.misses = tally.misses;
      landmark.log_odds = tally.log_odds;
      landmark.last_seen = tally.hits > 0 ? database.sightings() : landmark.last_seen;
    });
  }
}

/// Puts a part of the drive into the database of what it showed.
Status DatabaseUpdate::learn(const LandmarkDatabase& database, std::vector<Frame> frames,
                             SurveyBuilder& dynamic) const {
  std::vector<Sighting> sightings;
  std::vector<KnownSight> known;
  std::vector<SightingsApart> apart;
  const double loosened = params_.database.adjustment.on ? kFramesOfALandmark : 1.0;
  for (Frame& frame : frames) {
    for (const FrameMatch& match : frame.matches) {
      if (const Landmark* landmark = database.find(match.landmark)) {
        known.push_back({sightings.size(), match.feature, landmark});
      }
    }
    if (frame.last_T_eye && !sightings.empty()) {
      apart.push_back({sightings.size() - 1, sightings.size(), *frame.last_T_eye});
    }
    sightings.push_back(std::move(frame.sighting));
    // Poses that lean on the same landmarks know no more together than one of them does.
    sightings.back().pose_covariance *= loosened;
  }
  if (const auto adjusted = adjust_poses(geometry_, params_.database, sightings, known, apart); !adjusted) {
    return tl::unexpected(adjusted.error());
  }
  const double most_m = params_.max_teaching_sigma_m;
  for (const Sighting& sighting : sightings) {
    const Matrix2 place = sighting.pose_covariance.topLeftCorner<2, 2>();
    if (most_m > 0.0 && largest_sigma(place) > most_m) {
      continue;
    }
    if (const auto added = dynamic.add(sighting); !added) {
      return tl::unexpected(added.error());
    }
  }
  return {};
}

/// Of a drive's landmarks those seen most often first, where the sparsity rule is to prefer them.
std::vector<std::size_t> DatabaseUpdate::by_worth(const LandmarkDatabase& dynamic) const {
  std::vector<std::size_t> order(dynamic.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (params_.database.sparsity.best_first) {
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return dynamic.at(a).seen > dynamic.at(b).seen; });
  }
  return order;
}

/// Spec S2.10: what is not known already, is not too close to what is, and was seen often enough.
void DatabaseUpdate::add_new(const LandmarkDatabase& dynamic, LandmarkDatabase& database, UpdateCounts& counts) const {
  std::vector<vision::StereoFeature> views;
  std::vector<SeenPoint> points;
  for (const Landmark& landmark : dynamic.landmarks()) {
    SeenPoint point;
    point.feature = views.size();
    point.map = {landmark.p_map, landmark.covariance()};
    point.to_eye = landmark.to_eye;
    point.scale_m = landmark.scale_m;
    points.push_back(point);
    vision::StereoFeature feature;
    feature.descriptor = landmark.views.front().descriptor;
    views.push_back(feature);
  }
  std::vector<bool> known(points.size(), false);
  for (const Pairing& pair : associate(database, views, points, params_.database.association)) {
    known[pair.point] = true;
    ++counts.duplicates;
  }
  for (const std::size_t i : by_worth(dynamic)) {
    Landmark landmark = dynamic.at(i);
    if (known[i] || landmark.seen < params_.database.salient_seen) {
      continue;
    }
    if (!may_insert(database, points[i], landmark.views.front().descriptor, params_.database.sparsity,
                    params_.database.association.metric)) {
      ++counts.sparsified;
      continue;
    }
    landmark.expected = std::max(landmark.expected, landmark.seen);
    landmark.last_seen = database.sightings();
    database.insert(std::move(landmark));
    ++counts.added;
  }
}

Result<StagedUpdate> DatabaseUpdate::stage(const LandmarkDatabase& database) const {
  if (frames_ == 0) {
    return fail(Errc::kNotReady,
                "no frame was taken while the robot was LOCALISED; drive through the surveyed part of the building");
  }
  StagedUpdate staged{database, {}};
  staged.counts.frames = frames_;
  SurveyBuilder dynamic = dynamic_;
  if (const Status learned = learn(database, recent_, dynamic); !learned) {
    return tl::unexpected(learned.error());
  }
  staged.counts.dynamic = static_cast<int>(dynamic.database().size());
  staged.counts.before = database.size();
  apply_tallies(staged.database);
  staged.counts.removed =
      static_cast<int>(staged.database.erase_if([this](const Landmark& landmark) { return is_gone(landmark); }));
  const auto most = params_.max_removed_share * static_cast<double>(database.size());
  if (static_cast<double>(staged.counts.removed) > most) {
    return fail(Errc::kRefused, "the update would remove " + std::to_string(staged.counts.removed) + " of " +
                                    std::to_string(database.size()) +
                                    " landmarks; the pose may have been wrong: check it, or survey the building again");
  }
  add_new(dynamic.database(), staged.database, staged.counts);
  staged.counts.after = staged.database.size();
  return staged;
}

void DatabaseUpdate::clear() {
  dynamic_.clear();
  recent_.clear();
  tallies_.clear();
  last_eye_.reset();
  last_T_eye_.reset();
  frames_ = 0;
}

}  // namespace seeker::localize
