#include "server/localize/stereo_localiser.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <utility>

#include <Eigen/Eigenvalues>

#include "common/core/assert.hpp"
#include "server/localize/confidence.hpp"
#include "server/localize/landmark_map.hpp"
#include "server/localize/relocaliser.hpp"
#include "server/localize/tracking_matcher.hpp"

namespace seeker::localize {
namespace {

/// What UNKNOWN reports: as large as a building.
constexpr double kAnywhere_m = 1000.0;

Status check_database(const StereoGeometry& geometry, const LandmarkDatabase& database) {
  if (database.calibration() != calibration_hash(geometry)) {
    return fail(Errc::kInvalidArgument,
                "the landmarks were surveyed with another camera calibration (hash " +
                    std::to_string(database.calibration()) + ", this camera has " +
                    std::to_string(calibration_hash(geometry)) +
                    "); use the calibration file of the survey, or survey again with this camera");
  }
  if (database.empty()) {
    return fail(Errc::kNotReady, "the database has no landmarks; survey the building first");
  }
  return {};
}

bool is_guess(const RelocaliseAnswer& answer, const RelocaliseParams& params) {
  const auto inliers = static_cast<int>(answer.inliers.size());
  return inliers >= params.guess_inliers && inliers >= params.min_lead * answer.rival_inliers;
}

}  // namespace

struct StereoLocaliser::State {
  /// A place that the whole database was asked for.
  struct FoundPlace {
    EyeBelief at;
    bool guessed = false;  ///< by too few matches to believe it
  };

  StereoGeometry geometry;
  LocaliserParams params;
  LandmarkMap map;
  Confidence confidence;
  EyeBelief belief;
  bool somewhere = false;                       ///< the belief is valid: LOCALISED, DEGRADED or just LOST
  EyeBelief moved;                              ///< by odometry since the last frame, in the frame of the eye then
  std::optional<FoundPlace> found;              ///< to be confirmed by another frame
  std::unordered_map<LandmarkId, int> repeats;  ///< updates that each landmark took part in
  LocaliserStep step;

  State(const StereoGeometry& geometry_in, std::shared_ptr<const LandmarkDatabase> database,
        const LocaliserParams& params_in)
      : geometry(geometry_in),
        params(params_in),
        map(std::move(database), params_in),
        confidence(params_in.confidence) {}

  void begin(const EyeBelief& at);
  [[nodiscard]] EyeBelief belief_of(const Pose2& map_T_base, const Matrix3& covariance) const;
  void track(std::span<const vision::StereoFeature> features, std::span<const EyeFeature> lifted);
  [[nodiscard]] std::vector<Pairing> candidates(std::span<const vision::StereoFeature> features,
                                                std::span<const EyeFeature> lifted,
                                                std::span<const ExpectedLandmark> expected) const;
  void correct(std::span<const Pairing> pairs, std::span<const EyeFeature> lifted);
  void look(std::span<const vision::StereoFeature> features, std::span<const EyeFeature> lifted);
  [[nodiscard]] bool confirm(std::span<const vision::StereoFeature> features, std::span<const EyeFeature> lifted);
  void search(std::span<const vision::StereoFeature> features, std::span<const EyeFeature> lifted, Rng& rng);
  void judge(const FrameEvidence& frame);
  void report_quality();
};

void StereoLocaliser::State::begin(const EyeBelief& at) {
  belief = at;
  somewhere = true;
  found.reset();
  repeats.clear();
  confidence.reset();
}

EyeBelief StereoLocaliser::State::belief_of(const Pose2& map_T_base, const Matrix3& covariance) const {
  EyeBelief at;
  at.map_T_eye = eye_from_base(map_T_base, params.arm);
  at.covariance.topLeftCorner<3, 3>() = eye_covariance(map_T_base, covariance, params.arm);
  at.covariance(3, 3) = params.disparity_offset_sigma_px * params.disparity_offset_sigma_px;
  return at;
}

std::vector<Pairing> StereoLocaliser::State::candidates(std::span<const vision::StereoFeature> features,
                                                        std::span<const EyeFeature> lifted,
                                                        std::span<const ExpectedLandmark> expected) const {
  if (params.mode == FilterMode::kJoint) {
    return match_in_windows(geometry, map, belief, features, lifted, expected, params);
  }
  std::vector<SeenPoint> points(lifted.size());
  for (std::size_t i = 0; i < lifted.size(); ++i) {
    points[i].feature = lifted[i].feature;
  }
  AssociationParams anywhere;
  anywhere.metric = params.metric;
  anywhere.max_distance = params.tracking.max_distance;
  return associate_anywhere(map.table, features, points, anywhere);
}

/// Corrects the belief with the pairs that pass the gate and, jointly, agree with each other.
void StereoLocaliser::State::correct(std::span<const Pairing> pairs, std::span<const EyeFeature> lifted) {
  std::vector<RangeBearing> gated;
  std::vector<Pairing> owners;
  for (const Pairing& pair : pairs) {
    const auto known = repeats.find(map.at(pair.landmark).id);
    const int seen_before = known != repeats.end() ? known->second : 0;
    const double counts = std::min(seen_before + 1, params.max_repeats);
    const RangeBearing seen = with_landmark(lifted[pair.point], map, pair.landmark, counts, params);
    const auto innovation = innovate(belief, seen);
    if (innovation && innovation->chi2 <= params.tracking.gate_chi2) {
      gated.push_back(seen);
      owners.push_back(pair);
    }
  }
  std::vector<std::size_t> chosen(gated.size());
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    chosen[i] = i;
  }
  if (params.mode == FilterMode::kJoint) {
    chosen = agreeing(belief, gated, params.tracking);
  }
  std::vector<RangeBearing> used;
  for (const std::size_t i : chosen) {
    used.push_back(gated[i]);
    step.inliers.push_back({lifted[owners[i].point].feature, map.at(owners[i].landmark).id});
  }
  // The paper corrects with any number of matches.
  const int least = params.mode == FilterMode::kPaper ? 1 : params.confidence.min_update_inliers;
  if (static_cast<int>(used.size()) < least) {
    return;
  }
  step.nis = params.mode == FilterMode::kJoint ? update_together(belief, used, params.batch)
                                               : update_sequentially(belief, used);
  step.corrected = true;
  for (const FrameMatch& match : step.inliers) {
    ++repeats[match.landmark];
  }
}

/// What should show, what does, and the belief corrected with it.
void StereoLocaliser::State::look(std::span<const vision::StereoFeature> features, std::span<const EyeFeature> lifted) {
  belief.covariance(3, 3) += params.disparity_offset_walk_px * params.disparity_offset_walk_px;
  const auto expected = expected_landmarks(geometry, map, belief, params);
  for (const ExpectedLandmark& one : expected) {
    step.expected.push_back(map.at(one.landmark).id);
  }
  const std::vector<Pairing> pairs = candidates(features, lifted, expected);
  step.matched = static_cast<int>(pairs.size());
  correct(pairs, lifted);
}

void StereoLocaliser::State::track(std::span<const vision::StereoFeature> features,
                                   std::span<const EyeFeature> lifted) {
  look(features, lifted);
  judge({true,
         {},
         step.in_range,
         static_cast<int>(step.expected.size()),
         static_cast<int>(step.inliers.size()),
         step.nis});
}

/// Whether the frame shows what it should from the place that an earlier one found: that asks for much less than to
/// find it once more. Of a guess it asks for a share of all that is expected, since some of it is met anywhere. A frame
/// that shows plenty, and not that, speaks against the place; one that shows little says nothing.
bool StereoLocaliser::State::confirm(std::span<const vision::StereoFeature> features,
                                     std::span<const EyeFeature> lifted) {
  const EyeBelief aside = std::exchange(belief, found->at);
  const auto repeats_aside = std::exchange(repeats, {});
  look(features, lifted);
  const auto seen = static_cast<int>(step.inliers.size());
  const double needed =
      found->guessed ? params.relocalise.guess_share * static_cast<double>(step.expected.size()) : 0.0;
  if (step.corrected && seen >= params.confidence.min_inliers && seen >= needed) {
    begin(EyeBelief(belief));
    step.relocalised = true;
    judge({true, {}, step.in_range, 0, seen, step.nis});
    return true;
  }
  const int plenty = params.confidence.plenty;
  if (step.in_range >= plenty && static_cast<int>(step.expected.size()) >= plenty) {
    found.reset();
  }
  belief = aside;
  repeats = repeats_aside;
  step.inliers.clear();
  step.expected.clear();
  step.matched = 0;
  step.nis = 0.0;
  step.corrected = false;
  return false;
}

/// Asks the whole database; a place that two frames agree on is where the robot is.
void StereoLocaliser::State::search(std::span<const vision::StereoFeature> features, std::span<const EyeFeature> lifted,
                                    Rng& rng) {
  if (found && largest_sigma(found->at.covariance.topLeftCorner<2, 2>()) > params.confidence.lost_sigma_m) {
    found.reset();
  }
  if (found && confirm(features, lifted)) {
    return;
  }
  const RelocaliseAnswer answer = relocalise(geometry, map, features, lifted, params, rng);
  if (answer.verdict != RelocaliseVerdict::kFound) {
    if (!found && is_guess(answer, params.relocalise)) {
      found = FoundPlace{answer.belief, true};
    }
    step.cause = step.cause.empty() ? answer.reason : step.cause + "; " + answer.reason;
    return;
  }
  const Pose2& now = answer.belief.map_T_eye;
  const bool confirmed =
      found && distance_m(found->at.map_T_eye, now) <= params.relocalise.confirm_m &&
      std::abs(wrap_angle(found->at.map_T_eye.theta_rad - now.theta_rad)) <= params.relocalise.confirm_rad;
  if (!confirmed) {
    found = FoundPlace{answer.belief, false};
    step.cause = "a place was found, another frame must confirm it";
    return;
  }
  begin(answer.belief);
  step.relocalised = true;
  step.corrected = true;
  step.matched = answer.candidates;
  step.inliers.clear();
  step.expected.clear();
  for (const Pairing& pair : answer.inliers) {
    step.inliers.push_back({lifted[pair.point].feature, map.at(pair.landmark).id});
  }
  // Judged by its inliers alone: they fitted the pose, so that their innovations prove nothing.
  judge({true, {}, step.in_range, 0, static_cast<int>(step.inliers.size()), 0.0});
}

void StereoLocaliser::State::judge(const FrameEvidence& frame) {
  const Matrix3 covariance = belief.pose_covariance();
  confidence.judge(frame, largest_sigma(covariance.topLeftCorner<2, 2>()), std::sqrt(covariance(2, 2)));
  report_quality();
}

void StereoLocaliser::State::report_quality() {
  step.quality = confidence.quality();
  step.cause = confidence.cause();
  step.confidence = confidence.value();
}

StereoLocaliser::StereoLocaliser(std::unique_ptr<State> state) : state_(std::move(state)) {}
StereoLocaliser::StereoLocaliser(StereoLocaliser&&) noexcept = default;
StereoLocaliser& StereoLocaliser::operator=(StereoLocaliser&&) noexcept = default;
StereoLocaliser::~StereoLocaliser() = default;

Result<StereoLocaliser> StereoLocaliser::create(const StereoGeometry& geometry,
                                                std::shared_ptr<const LandmarkDatabase> database,
                                                const LocaliserParams& params) {
  SEEKER_ASSERT(database != nullptr);
  for (const Status& ok : {seeker::validate(geometry), validate(params), check_database(geometry, *database)}) {
    if (!ok) {
      return tl::unexpected(ok.error());
    }
  }
  StereoLocaliser localiser(std::make_unique<State>(geometry, std::move(database), params));
  localiser.start_anywhere();
  return localiser;
}

Status StereoLocaliser::use(std::shared_ptr<const LandmarkDatabase> database) {
  SEEKER_ASSERT(database != nullptr);
  if (Status ok = check_database(state_->geometry, *database); !ok) {
    return ok;
  }
  state_->map = LandmarkMap(std::move(database), state_->params);
  return {};
}

Status StereoLocaliser::start_at(const Pose2& map_T_base, const Matrix3& covariance) {
  const bool valid =
      is_finite(map_T_base) && covariance.allFinite() &&
      Eigen::SelfAdjointEigenSolver<Matrix3>(covariance, Eigen::EigenvaluesOnly).eigenvalues().minCoeff() >= 0.0;
  if (!valid) {
    return fail(Errc::kInvalidArgument, "the pose to start from is not finite or its covariance is none");
  }
  state_->begin(state_->belief_of(map_T_base, covariance));
  state_->step = {};
  state_->step.quality = LocalisationQuality::kLocalised;
  return {};
}

void StereoLocaliser::start_anywhere() {
  State& s = *state_;
  const Matrix3 anywhere =
      Eigen::Vector3d(kAnywhere_m * kAnywhere_m, kAnywhere_m * kAnywhere_m, kPi * kPi).asDiagonal();
  s.begin(s.belief_of({}, anywhere));
  s.somewhere = false;
  s.step = {};
  s.step.cause = "no frame has determined the place yet";
}

void StereoLocaliser::predict(const Twist2& velocity, double tau_s) {
  State& s = *state_;
  const bool exact = s.params.mode == FilterMode::kJoint;
  localize::predict(s.moved, velocity, tau_s, s.params.arm, s.params.motion, exact);
  if (s.somewhere) {
    localize::predict(s.belief, velocity, tau_s, s.params.arm, s.params.motion, exact);
  }
  if (s.found) {
    localize::predict(s.found->at, velocity, tau_s, s.params.arm, s.params.motion, exact);
  }
}

const LocaliserStep& StereoLocaliser::update(std::span<const vision::StereoFeature> features, Rng& rng) {
  State& s = *state_;
  const LocalisationQuality before = s.step.quality;
  s.step = {};
  s.step.quality = before;
  s.step.last_T_eye = {s.moved.map_T_eye, s.moved.pose_covariance()};
  s.moved = {};
  const std::vector<EyeFeature> lifted = lift(s.geometry, features, s.params);
  s.step.features = static_cast<int>(features.size());
  s.step.in_range = static_cast<int>(lifted.size());
  const bool lost = before == LocalisationQuality::kLost || !s.somewhere;
  if (!lost) {
    s.track(features, lifted);
  }
  const bool blind = s.confidence.blind_frames() >= s.params.confidence.relocalise_after;
  if (lost || blind || s.step.quality == LocalisationQuality::kLost) {
    s.search(features, lifted, rng);
  } else {
    s.found.reset();
  }
  return s.step;
}

const LocaliserStep& StereoLocaliser::miss(const std::string& cause) {
  State& s = *state_;
  const LocalisationQuality before = s.step.quality;
  s.step = {};
  s.step.quality = before;
  if (s.somewhere && before != LocalisationQuality::kLost) {
    s.judge({false, cause, 0, 0, 0, 0.0});
  } else {
    s.step.cause = cause;
  }
  return s.step;
}

const LocaliserStep& StereoLocaliser::last() const { return state_->step; }

PoseEstimate StereoLocaliser::estimate(RobotTime stamp) const {
  const State& s = *state_;
  PoseEstimate estimate;
  estimate.stamp = stamp;
  estimate.quality = s.step.quality;
  estimate.cause = s.step.cause;
  estimate.covariance = s.belief.pose_covariance();
  if (s.somewhere) {
    estimate.map_T_base = base_from_eye(s.belief.map_T_eye, s.params.arm);
    estimate.covariance = base_covariance(s.belief.map_T_eye, estimate.covariance, s.params.arm);
    const double place_m2 = s.params.map_sigma_m * s.params.map_sigma_m;
    estimate.covariance.diagonal() +=
        Eigen::Vector3d(place_m2, place_m2, s.params.map_sigma_rad * s.params.map_sigma_rad);
  }
  return estimate;
}

const EyeBelief& StereoLocaliser::belief() const { return state_->belief; }
const LocaliserParams& StereoLocaliser::params() const { return state_->params; }

}  // namespace seeker::localize
