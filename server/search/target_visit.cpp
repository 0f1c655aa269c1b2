#include "server/search/target_visit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/angle.hpp"
#include "common/core/text.hpp"
#include "server/nav/visibility.hpp"
#include "server/search/goal_chooser.hpp"

namespace seeker::search {
namespace {

constexpr int kDirections = 24;
constexpr double kFaceGain_1_s = 1.5;
constexpr double kFaceMaxOmega_rad_s = 0.6;
constexpr double kFaceTime_s = 10.0;
constexpr double kArriveTolerance_m = 0.15;
/// The last stretch before a target belongs to the target itself in the occupancy.
constexpr double kTargetExtent_m = 0.2;
/// Approaches without a position: how often to look before giving up.
constexpr int kMaxApproachLooks = 3;

Point2 ahead(const Pose2& pose, double heading_rad, double distance_m) {
  return pose.translation() + distance_m * Point2(std::cos(heading_rad), std::sin(heading_rad));
}

/// To the left or the right of a bearing, from where it has the most parallax: the nearer of the two, away from
/// `others`.
std::optional<Point2> place_beside(const nav::FloorView& floor, const Pose2& map_T_base, double bearing_map_rad,
                                   double step_m, const std::vector<Point2>& others, double away_m) {
  const auto costs = nav::DistanceField::build(floor.cost, map_T_base.translation());
  std::optional<Point2> best;
  double best_cost = 0.0;
  for (const double side_rad : {kPi / 2.0, -kPi / 2.0}) {
    const Point2 p = ahead(map_T_base, bearing_map_rad + side_rad, step_m);
    const auto cost = costs ? costs->cost_to(p) : std::nullopt;
    if (cost && (!best || *cost < best_cost) && !nav::near_any(p, others, away_m)) {
      best = p;
      best_cost = *cost;
    }
  }
  return best;
}

bool sees(const nav::FloorView& floor, const Point2& from, const Point2& target) {
  const Point2 d = target - from;
  const double r = d.norm();
  return r <= kTargetExtent_m || nav::line_of_sight(floor.occupancy, from, from + (r - kTargetExtent_m) / r * d);
}

}  // namespace

std::optional<Point2> viewpoint_about(const nav::FloorView& floor, const Pose2& map_T_base, const Point2& p_map,
                                      const std::vector<double>& radii_m, const std::vector<Point2>& others,
                                      double away_m) {
  const auto costs = nav::DistanceField::build(floor.cost, map_T_base.translation());
  if (!costs) {
    return std::nullopt;
  }
  for (const double radius : radii_m) {
    std::optional<Point2> best;
    double best_cost = 0.0;
    for (int k = 0; k < kDirections; ++k) {
      const double angle = kTwoPi * k / kDirections;
      const Point2 p = p_map + radius * Point2(std::cos(angle), std::sin(angle));
      const auto cost = costs->cost_to(p);
      if (cost && (!best || *cost < best_cost) && !nav::near_any(p, others, away_m) && sees(floor, p, p_map)) {
        best = p;
        best_cost = *cost;
      }
    }
    if (best) {
      return best;
    }
  }
  return std::nullopt;
}

TargetVisit::TargetVisit(const SearchParams& params, LocalPlanner planner, bool use_map)
    : params_(params.mission),
      new_place_m_(params.detection.new_place_m),
      sure_score_(params.detection.sure_score),
      drive_(params, std::move(planner), use_map) {}

void TargetVisit::begin(std::uint64_t id, bool approach, RobotTime now) {
  id_ = id;
  active_ = true;
  approach_ = approach;
  arrived_ = false;
  looks_ = 0;
  viewed_from_.clear();
  state_ = State::kPlan;
  started_ = now;
}

VisitResult TargetVisit::finish(VisitResult result) {
  active_ = false;
  drive_.stop();
  return result;
}

std::optional<VisitResult> TargetVisit::verdict(const Detection& detection, RobotTime now) const {
  const double spent_s = to_seconds(now - started_);
  if (approach_) {
    return approach_verdict(detection, spent_s);
  }
  if (detection.confirmed) {
    return VisitResult::kConfirmed;
  }
  if (looks_ >= params_.confirm_looks || spent_s > params_.confirm_time_s) {
    return VisitResult::kRefused;
  }
  return std::nullopt;
}

std::optional<VisitResult> TargetVisit::approach_verdict(const Detection& detection, double spent_s) const {
  const bool seen = detection.sightings > sightings_before_;
  const int misses = detection.misses - misses_before_;
  if (looks_ > 0 && arrived_ && seen) {
    return VisitResult::kReached;
  }
  if (looks_ >= kMaxApproachLooks || spent_s > params_.approach_time_s) {
    // A sure track stands unless a look that should have shown it did not.
    const bool sure = detection.score >= sure_score_ || !drive_.uses_map();
    return seen || (sure && misses == 0) ? VisitResult::kReached : VisitResult::kRefused;
  }
  return std::nullopt;
}

VisitResult TargetVisit::step(const StrategyInput& input, const DetectionTracker& tracker, StrategyStep& out) {
  out.phase = approach_ ? "approach" : "confirm";
  const auto detection = tracker.find(id_);
  if (!detection) {
    return finish(approach_ ? VisitResult::kReached : VisitResult::kRefused);
  }
  if (state_ == State::kLook) {
    here_ = input.map_T_base.translation();
  }
  if (state_ == State::kPlan) {
    if (const auto result = verdict(*detection, input.now)) {
      return finish(*result);
    }
    plan(input, tracker, *detection);
  }
  switch (state_) {
    case State::kDrive: drive(input, out); break;
    case State::kFace: face(input, *detection, out); break;
    case State::kPlan:
    case State::kLook: break;
  }
  if (state_ == State::kLook) {
    out.wants_image = true;
    out.activity = approach_ ? "observing the target from near" : "observing it again from another place";
  }
  return VisitResult::kBusy;
}

void TargetVisit::plan(const StrategyInput& input, const DetectionTracker& tracker, const Detection& detection) {
  face_since_ = input.now;
  if (!detection.position_map && looks_ == 0) {
    // Facing it brings the front sonars to bear, which the ring's sides and back may lack.
    state_ = State::kFace;
    return;
  }
  if (approach_) {
    plan_approach(input, detection);
  } else {
    plan_confirm(input, tracker, detection);
  }
}

void TargetVisit::plan_approach(const StrategyInput& input, const Detection& detection) {
  state_ = State::kDrive;
  if (!detection.position_map) {
    if (!drive_.start(input, ahead(input.map_T_base, detection.bearing_map_rad, params_.confirm_step_m),
                      kArriveTolerance_m)) {
      state_ = State::kFace;
    }
    return;
  }
  const Point2 target = *detection.position_map;
  const double range = (target - input.map_T_base.translation()).norm();
  arrived_ = true;
  if (looks_ == 0 && std::abs(range - params_.standoff_m) <= params_.standoff_tolerance_m) {
    state_ = State::kFace;
    return;
  }
  std::optional<Point2> goal;
  const auto floor = input.floors.view();
  if (drive_.uses_map() && floor) {
    constexpr double kWider = 1.4;
    constexpr double kWidest = 2.0;
    goal = viewpoint_about(**floor, input.map_T_base, target,
                           {params_.standoff_m, kWider * params_.standoff_m, kWidest * params_.standoff_m},
                           viewed_from_, new_place_m_);
  } else if (!drive_.uses_map() && range > params_.standoff_m) {
    goal = target - params_.standoff_m / range * (target - input.map_T_base.translation());
  }
  if (!goal || !drive_.start(input, *goal, kArriveTolerance_m)) {
    state_ = State::kFace;
  }
}

void TargetVisit::plan_confirm(const StrategyInput& input, const DetectionTracker& tracker,
                               const Detection& detection) {
  const std::vector<Point2> places = tracker.places(id_);
  std::optional<Point2> goal;
  const auto floor = input.floors.view();
  if (detection.position_map && drive_.uses_map() && floor) {
    const double range = (*detection.position_map - input.map_T_base.translation()).norm();
    // Nearer than now, so that a true target is seen better than before; else from wherever it can be seen.
    const double nearer = std::clamp(0.7 * range, params_.standoff_m, 2.0);
    goal = viewpoint_about(**floor, input.map_T_base, *detection.position_map,
                           {nearer, params_.standoff_m, 1.3 * nearer, 2.0}, places, 1.2 * new_place_m_);
  } else if (!detection.position_map && drive_.uses_map() && floor) {
    goal = place_beside(**floor, input.map_T_base, detection.bearing_map_rad, params_.confirm_step_m, places,
                        new_place_m_);
    if (!goal) {
      goal = viewpoint_about(**floor, input.map_T_base, input.map_T_base.translation(), {params_.confirm_step_m},
                             places, new_place_m_);
    }
  } else if (!drive_.uses_map()) {
    goal = ahead(input.map_T_base, detection.bearing_map_rad, params_.confirm_step_m);
  }
  state_ = State::kDrive;
  if (!goal || !drive_.start(input, *goal, kArriveTolerance_m)) {
    state_ = State::kLook;  // no other place: another picture from here is all there is
  }
}

void TargetVisit::drive(const StrategyInput& input, StrategyStep& out) {
  const nav::DriveStep step = drive_.step(input);
  out.command = step.command;
  out.planned_path = drive_.path(input.map_T_base);
  out.activity = approach_ ? "driving up to the target" : "driving to another place to see the target from";
  if (step.state != nav::DriveState::kDriving) {
    face_since_ = input.now;
    state_ = approach_ ? State::kFace : State::kLook;
  }
}

void TargetVisit::face(const StrategyInput& input, const Detection& detection, StrategyStep& out) {
  const double wanted = detection.position_map ? bearing_to(input.map_T_base, *detection.position_map)
                                               : wrap_angle(detection.bearing_map_rad - input.map_T_base.theta_rad);
  if (std::abs(wanted) <= params_.face_tolerance_rad || to_seconds(input.now - face_since_) > kFaceTime_s) {
    state_ = State::kLook;
    return;
  }
  out.activity = "rotating to face the target";
  out.command.omega_rad_s = std::clamp(kFaceGain_1_s * wanted, -kFaceMaxOmega_rad_s, kFaceMaxOmega_rad_s);
}

void TargetVisit::image_taken() {
  if (active_ && state_ == State::kLook) {
    ++looks_;
    viewed_from_.push_back(here_);
    state_ = State::kPlan;
  }
}

void TargetVisit::interrupted() {
  drive_.stop();
  if (active_ && state_ != State::kLook) {
    state_ = State::kPlan;
  }
}

}  // namespace seeker::search
