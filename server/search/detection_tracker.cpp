#include "server/search/detection_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Dense>

#include "common/core/angle.hpp"
#include "server/search/target_range.hpp"

namespace seeker::search {
namespace {

constexpr std::size_t kMaxObservations = 64;
/// Repeated sightings from one place share their errors: only the best of them is kept.
constexpr double kSamePlace_m = 0.1;
/// Two sightings of one object may differ by this distance: its extent.
constexpr double kTargetSpread_m = 0.15;

/// The surest range is that of the highest rank.
int rank(RangeSource source) {
  switch (source) {
    case RangeSource::kLidar: return 3;
    case RangeSource::kFloor: return 2;
    case RangeSource::kSonar: return 1;
    case RangeSource::kTriangulation:
    case RangeSource::kNone: break;
  }
  return 0;
}

bool better(RangeSource a, double score_a, RangeSource b, double score_b) {
  return rank(a) != rank(b) ? rank(a) > rank(b) : score_a > score_b;
}

}  // namespace

DetectionTracker::DetectionTracker(std::vector<SearchTarget> targets, const DetectionParams& params)
    : targets_(std::move(targets)), params_(params) {}

DetectionTracker::Observation DetectionTracker::observe(const Look& look, const vision::Sighting& sighting) const {
  Observation observation;
  observation.score = sighting.score;
  BearingRange& m = observation.measurement;
  m.map_T_camera = look.map_T_base * params_.base_T_camera;
  m.bearing_rad = wrap_angle(sighting.bearing_base_rad - params_.base_T_camera.theta_rad);
  m.bearing_sigma_rad = params_.bearing_sigma_rad;
  const bool on_floor = sighting.floor_range_m.has_value();
  const auto range = range_in_direction(sighting.bearing_base_rad, look.laser, on_floor ? nullptr : look.sonar,
                                        sighting.range_m, params_);
  if (range) {
    const SearchTarget& target = targets_[static_cast<std::size_t>(sighting.target)];
    m.range_m = range->range_m + target.depth_m / 2.0;
    if (range->source == RangeSource::kLidar && target.depth_m > 0.0) {
      const double width_m = std::max(target.width_m, target.depth_m);
      const auto middle = outline_bearing(*look.laser, sighting.bearing_base_rad, range->range_m, width_m, params_);
      m.bearing_rad = wrap_angle(middle.value_or(sighting.bearing_base_rad) - params_.base_T_camera.theta_rad);
    }
    m.range_sigma_m = std::hypot(range->sigma_m, params_.depth_sigma_m);
    observation.source = range->source;
  } else if (on_floor) {
    m.range_m = sighting.floor_range_m;
    m.range_sigma_m = params_.floor_sigma_m;
    observation.source = RangeSource::kFloor;
  }
  return observation;
}

std::optional<double> DetectionTracker::distance(const Track& track, const Observation& observation,
                                                 const Look& look) const {
  const BearingRange& m = observation.measurement;
  if (track.detection.position_map) {
    const Point2& p = *track.detection.position_map;
    const Matrix2 spread =
        kTargetSpread_m * kTargetSpread_m * Matrix2::Identity() + track.detection.position_covariance;
    if (m.range_m) {
      const PositionEstimate seen = position_of(m);
      const Matrix2 s = spread + seen.covariance + pose_contribution(seen.p_map, look.map_T_base, look.pose_covariance);
      const Point2 d = seen.p_map - p;
      const double d2 = d.dot(s.ldlt().solve(d));
      return d2 <= params_.gate_position ? std::optional(d2 / params_.gate_position) : std::nullopt;
    }
    const Point2 d = p - m.map_T_camera.translation();
    const double r = std::max(d.norm(), kTargetSpread_m);
    const Point2 across = Point2(-d.y(), d.x()) / (r * r);
    const double variance =
        m.bearing_sigma_rad * m.bearing_sigma_rad + look.pose_covariance(2, 2) + across.dot(spread * across);
    const double error = wrap_angle(m.bearing_rad + m.map_T_camera.theta_rad - std::atan2(d.y(), d.x()));
    const double d2 = error * error / variance;
    return d2 <= params_.gate_bearing ? std::optional(d2 / params_.gate_bearing) : std::nullopt;
  }
  // The track has only a bearing: the new sighting must meet it in front of both.
  std::vector<BearingRange> both{track.observations.back().measurement, m};
  if (const auto meet = estimate_position(both, params_.min_parallax_rad, params_.max_bearing_range_m)) {
    const double gate = params_.gate_bearing;
    return meet->chi2 <= gate ? std::optional(meet->chi2 / gate) : std::nullopt;
  }
  const double turned = std::abs(wrap_angle(both[0].map_T_camera.theta_rad + both[0].bearing_rad -
                                            both[1].map_T_camera.theta_rad - both[1].bearing_rad));
  return !m.range_m && turned < params_.min_parallax_rad ? std::optional(1.0) : std::nullopt;
}

DetectionTracker::Track* DetectionTracker::match(const Observation& observation, int target, const Look& look,
                                                 const std::vector<std::uint64_t>& taken) {
  Track* best = nullptr;
  double best_distance = 0.0;
  for (Track& track : tracks_) {
    // One picture shows one object once.
    const bool used = std::find(taken.begin(), taken.end(), track.detection.id) != taken.end();
    if (used || track.detection.target != target) {
      continue;
    }
    const auto d = distance(track, observation, look);
    if (d && (best == nullptr || *d < best_distance)) {
      best = &track;
      best_distance = *d;
    }
  }
  return best;
}

std::vector<std::uint64_t> DetectionTracker::add(const Look& look) {
  std::vector<std::uint64_t> touched;
  for (const vision::Sighting& sighting : look.sightings) {
    const bool known = sighting.target >= 0 && static_cast<std::size_t>(sighting.target) < targets_.size();
    if (!known || !std::isfinite(sighting.bearing_base_rad)) {
      continue;
    }
    const Observation observation = observe(look, sighting);
    Track* track = match(observation, sighting.target, look, touched);
    if (track == nullptr) {
      tracks_.emplace_back();
      track = &tracks_.back();
      track->detection.id = next_id_++;
      track->detection.target = sighting.target;
      track->detection.sightings = 0;
    }
    join(*track, observation, sighting, look);
    touched.push_back(track->detection.id);
  }
  return touched;
}

void DetectionTracker::join(Track& track, const Observation& observation, const vision::Sighting& sighting,
                            const Look& look) {
  Detection& d = track.detection;
  ++d.sightings;
  d.stamp = look.stamp;
  d.u_px = sighting.u_px;
  d.v_px = sighting.v_px;
  d.score = sighting.score;
  d.map_T_base = look.map_T_base;
  d.bearing_base_rad = wrap_angle(observation.measurement.bearing_rad + params_.base_T_camera.theta_rad);
  d.bearing_map_rad = wrap_angle(d.bearing_base_rad + look.map_T_base.theta_rad);  // eq (5)
  track.pose_covariance = look.pose_covariance;

  const Point2 here = look.map_T_base.translation();
  if (std::none_of(track.places.begin(), track.places.end(),
                   [&](const Point2& p) { return (p - here).norm() < params_.new_place_m; })) {
    track.places.push_back(here);
  }
  const auto same = std::find_if(track.observations.begin(), track.observations.end(), [&](const Observation& o) {
    return (o.measurement.map_T_camera.translation() - observation.measurement.map_T_camera.translation()).norm() <
           kSamePlace_m;
  });
  if (same == track.observations.end()) {
    if (track.observations.size() == kMaxObservations) {
      track.observations.erase(track.observations.begin());
    }
    track.observations.push_back(observation);
  } else if (better(observation.source, observation.score, same->source, same->score)) {
    *same = observation;
  }
  estimate(track);
  track.unseen = 1.0;
  track.by_size_map.reset();
  if (sighting.range_m) {
    const BearingRange& m = observation.measurement;
    track.by_size_map = m.map_T_camera * Point2(*sighting.range_m * std::cos(m.bearing_rad),
                                                *sighting.range_m * std::sin(m.bearing_rad));
  }
  const bool located = d.position_map.has_value() || !params_.confirm_position;
  const bool seen_enough = static_cast<int>(track.places.size()) >= params_.confirm_places;
  d.confirmed = d.confirmed || (seen_enough && located) || sighting.score >= params_.sure_score;
}

void DetectionTracker::estimate(Track& track) const {
  std::vector<BearingRange> all;
  RangeSource source = RangeSource::kTriangulation;
  for (const Observation& o : track.observations) {
    all.push_back(o.measurement);
    if (rank(o.source) > rank(source)) {
      source = o.source;
    }
  }
  const auto fused = estimate_position(all, params_.min_parallax_rad, params_.max_bearing_range_m);
  if (!fused) {
    return;
  }
  // Sightings that do not fit their fusion make it less certain than their noise says.
  const double excess = std::max(1.0, fused->chi2 / std::max<double>(1.0, 2.0 * static_cast<double>(all.size())));
  Detection& d = track.detection;
  d.position_map = fused->p_map;
  d.position_covariance =
      excess * fused->covariance + pose_contribution(fused->p_map, d.map_T_base, track.pose_covariance);
  d.range_source = source;
}

std::vector<std::uint64_t> DetectionTracker::note_misses(const std::vector<std::uint64_t>& seen,
                                                         const ShouldSee& should_see) {
  std::vector<std::uint64_t> refuted;
  for (Track& track : tracks_) {
    Detection& d = track.detection;
    const bool was_seen = std::find(seen.begin(), seen.end(), d.id) != seen.end();
    const auto place = presumed_place_of(track);
    if (!was_seen && place && miss(track, should_see(*place, d.target))) {
      refuted.push_back(d.id);
    }
  }
  for (const std::uint64_t id : refuted) {
    refute(id);
  }
  return refuted;
}

bool DetectionTracker::miss(Track& track, double p) const {
  Detection& d = track.detection;
  track.unseen *= 1.0 - p;
  d.misses += d.position_map && p >= params_.miss_probability ? 1 : 0;
  const bool doubtful = d.sightings == 1 && params_.doubtful(d.score);
  return !d.confirmed &&
         (d.misses - d.sightings >= params_.max_misses || (doubtful && track.unseen < params_.doubtful_unseen));
}

void DetectionTracker::refute(std::uint64_t id) {
  tracks_.erase(std::remove_if(tracks_.begin(), tracks_.end(), [&](const Track& t) { return t.detection.id == id; }),
                tracks_.end());
}

std::vector<Detection> DetectionTracker::detections() const {
  std::vector<Detection> out;
  out.reserve(tracks_.size());
  for (const Track& track : tracks_) {
    out.push_back(track.detection);
  }
  return out;
}

const DetectionTracker::Track* DetectionTracker::track_of(std::uint64_t id) const {
  const auto found =
      std::find_if(tracks_.begin(), tracks_.end(), [id](const Track& track) { return track.detection.id == id; });
  return found == tracks_.end() ? nullptr : &*found;
}

std::optional<Detection> DetectionTracker::find(std::uint64_t id) const {
  const Track* track = track_of(id);
  return track != nullptr ? std::optional(track->detection) : std::nullopt;
}

std::vector<Point2> DetectionTracker::places(std::uint64_t id) const {
  const Track* track = track_of(id);
  return track != nullptr ? track->places : std::vector<Point2>{};
}

std::optional<Point2> DetectionTracker::presumed_place(std::uint64_t id) const {
  const Track* track = track_of(id);
  return track != nullptr ? presumed_place_of(*track) : std::nullopt;
}

void DetectionTracker::transform(const MapMove& move) {
  for (Track& track : tracks_) {
    for (Observation& o : track.observations) {
      o.measurement.map_T_camera = move * o.measurement.map_T_camera;
    }
    for (Point2& p : track.places) {
      p = move * p;
    }
    if (track.by_size_map) {
      track.by_size_map = move * *track.by_size_map;
    }
    const Pose2 new_T_old = move.at(track.detection.map_T_base.translation());
    track.detection.map_T_base = new_T_old * track.detection.map_T_base;
    track.detection.bearing_map_rad = wrap_angle(track.detection.bearing_map_rad + new_T_old.theta_rad);
    estimate(track);
  }
}

}  // namespace seeker::search
