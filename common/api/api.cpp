#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include <Eigen/Geometry>

#include "common/api/robot_api.hpp"
#include "common/core/angle.hpp"
#include "common/core/line_map.hpp"

namespace seeker::api {
namespace {

bool is_token(const std::string& text, std::size_t max_length) {
  return !text.empty() && text.size() <= max_length && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
  });
}

bool names_folder(char c) {
  const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  return letter || (c >= '0' && c <= '9') || c == '-' || c == '_' || c == '.';
}

double grey_sigma(const Image& grey) {
  double sum = 0.0;
  double sum2 = 0.0;
  for (const std::uint8_t value : grey.data()) {
    sum += value;
    sum2 += static_cast<double>(value) * value;
  }
  const auto n = static_cast<double>(grey.data().size());
  return std::sqrt(std::max(0.0, sum2 / n - (sum / n) * (sum / n)));
}

Status validate_picture(const TargetSpec& target) {
  const std::string who = "the picture of target '" + target.name + "' ";
  const int small = std::min(target.picture.width_px(), target.picture.height_px());
  const int large = std::max(target.picture.width_px(), target.picture.height_px());
  if (target.picture.empty() || small < kMinTargetSide_px) {
    return fail(Errc::kInvalidArgument, who + "is " + std::to_string(target.picture.width_px()) + "x" +
                                            std::to_string(target.picture.height_px()) +
                                            " pixels; give one of at least 8x8");
  }
  if (large > kMaxTargetSide_px) {
    return fail(Errc::kTooLarge, who + "is larger than 1024 pixels; scale it down");
  }
  if (grey_sigma(to_grey(target.picture)) < kMinTargetGreySigma) {
    return fail(Errc::kInvalidArgument, who + "has one colour only, so nothing can be matched; give one with contrast");
  }
  return {};
}

Status validate(const TargetSpec& target) {
  constexpr std::size_t kMaxName = 32;
  if (!is_token(target.name, kMaxName)) {
    return fail(Errc::kInvalidArgument,
                "target name '" + target.name.substr(0, kMaxName) + "' must be 1 to 32 of a-z, 0-9 and '-'");
  }
  if (target.recogniser == RecogniserKind::kSolid) {
    if (!target.picture.empty() || target.solid > kSolidKinds.back()) {
      return fail(Errc::kInvalidArgument,
                  "target '" + target.name + "' is a solid: name which one, and give no picture");
    }
  } else if (Status ok = validate_picture(target); !ok) {
    return ok;
  }
  constexpr double kMaxSize_m = 20.0;
  if (!(target.width_m > 0.0 && target.width_m <= kMaxSize_m && target.height_m > 0.0 &&
        target.height_m <= kMaxSize_m)) {
    return fail(Errc::kInvalidArgument, "the size of target '" + target.name + "' must be above 0 and at most 20 m");
  }
  return {};
}

Status validate_targets(const char* mission, const std::vector<TargetSpec>& targets) {
  if (targets.empty() || targets.size() > kMaxTargets) {
    return fail(Errc::kInvalidArgument,
                std::string(mission) + " needs 1 to 16 targets, got " + std::to_string(targets.size()));
  }
  std::set<std::string> names;
  for (const TargetSpec& target : targets) {
    if (Status ok = validate(target); !ok) {
      return ok;
    }
    if (!names.insert(target.name).second) {
      return fail(Errc::kInvalidArgument, "two targets have the name '" + target.name + "'");
    }
  }
  return {};
}

Status validate_keep_outs(const std::vector<Polygon>& keep_outs) {
  if (keep_outs.size() > kMaxKeepOuts) {
    return fail(Errc::kTooLarge, "more than 64 keep-out areas");
  }
  for (std::size_t i = 0; i < keep_outs.size(); ++i) {
    if (const Status ok = validate_polygon(keep_outs[i]); !ok) {
      return fail_with_context("keep-out area " + std::to_string(i + 1), ok.error());
    }
  }
  return {};
}

Status validate_areas(const std::optional<Polygon>& bound, const std::vector<Polygon>& keep_outs) {
  if (bound) {
    if (const Status ok = validate_polygon(*bound); !ok) {
      return fail_with_context("bound", ok.error());
    }
  }
  return validate_keep_outs(keep_outs);
}

Status validate_task(const SearchMission& search) {
  if (Status ok = validate_targets("a search", search.targets); !ok) {
    return ok;
  }
  if (search.explore && search.mode == SearchMode::kPaper) {
    return fail(Errc::kInvalidArgument, "the published search cannot explore as well; leave out one of the two");
  }
  return validate_areas(search.bound, search.keep_out);
}

Status validate_points(const char* what, const std::vector<Point2>& points) {
  const bool finite = std::all_of(points.begin(), points.end(), [](const Point2& p) { return p.allFinite(); });
  return finite ? Status() : fail(Errc::kInvalidArgument, std::string(what) + " is not a finite number");
}

Status validate_task(const GotoMission& go) {
  if (go.waypoints.empty() || go.waypoints.size() > kMaxWaypoints) {
    return fail(Errc::kInvalidArgument, "goto needs 1 to 1024 waypoints, got " + std::to_string(go.waypoints.size()));
  }
  if (Status ok = validate_points("a waypoint", go.waypoints); !ok) {
    return ok;
  }
  if (go.final_heading_rad && !std::isfinite(*go.final_heading_rad)) {
    return fail(Errc::kInvalidArgument, "the final heading is not a finite number");
  }
  return validate_keep_outs(go.keep_out);
}

Status validate_task(const ReturnMission& home) { return validate_areas(home.bound, home.keep_out); }

Status validate_task(const ExploreMission& explore) {
  if (explore.strategy > kExploreStrategies.back()) {
    return fail(Errc::kInvalidArgument, "there is no such strategy of exploration");
  }
  return validate_areas(explore.bound, explore.keep_out);
}

Status validate_headings(int headings) {
  if (headings < 1 || headings > kMaxHeadings) {
    return fail(Errc::kInvalidArgument, "the number of headings must be 1 to 72, got " + std::to_string(headings));
  }
  return {};
}

Status validate_landmarks(const std::string& name) {
  const Status ok = validate_map_name(name);
  return ok ? ok : fail(Errc::kInvalidArgument, "a database of landmarks is named like a map: " + ok.error().message);
}

Status validate_task(const SurveyMission& survey) {
  if (Status ok = validate_landmarks(survey.landmarks); !ok) {
    return ok;
  }
  if (Status ok = validate_headings(survey.headings); !ok) {
    return ok;
  }
  if (survey.places.size() > kMaxSurveyPlaces) {
    return fail(Errc::kTooLarge, "a survey has at most 64 places");
  }
  if (Status ok = validate_points("a place", survey.places); !ok) {
    return ok;
  }
  return validate_keep_outs(survey.keep_out);
}

Status validate_task(const LocaliseMission& localise) {
  const Status ok = validate_landmarks(localise.landmarks);
  return ok ? validate_headings(localise.headings) : ok;
}

Status validate_task(const RecogniseMission& recognise) {
  const Status ok = validate_targets("recognise", recognise.targets);
  return ok ? validate_headings(recognise.headings) : ok;
}

}  // namespace

Status validate_robot_id(std::string_view robot_id) {
  constexpr std::size_t kMaxId = 64;
  const bool fits = !robot_id.empty() && robot_id.size() <= kMaxId && robot_id.front() != '.';
  if (!fits || !std::all_of(robot_id.begin(), robot_id.end(), names_folder)) {
    return fail(Errc::kInvalidArgument, "must have 1 to 64 letters, digits, '-', '_' and '.', and not begin with '.'");
  }
  return {};
}

Detection moved(Detection detection, const Pose2& new_T_old) {
  detection.map_T_base = new_T_old * detection.map_T_base;
  detection.bearing_map_rad = wrap_angle(detection.bearing_map_rad + new_T_old.theta_rad);
  if (detection.position) {
    detection.position = new_T_old * *detection.position;
  }
  const Matrix2 turn = Eigen::Rotation2Dd(new_T_old.theta_rad).toRotationMatrix();
  detection.position_covariance = turn * detection.position_covariance * turn.transpose();
  return detection;
}

TargetSpec solid_target(SolidKind solid) {
  TargetSpec target;
  target.name = to_string(solid);
  target.width_m = target.height_m = target.depth_m = kSolidSize_m;
  target.recogniser = RecogniserKind::kSolid;
  target.solid = solid;
  return target;
}

Status validate(const MissionRequest& request) {
  constexpr std::size_t kMaxId = 64;
  if (!is_token(request.id, kMaxId)) {
    return fail(Errc::kInvalidArgument, "the mission id must be 1 to 64 of a-z, 0-9 and '-'");
  }
  if (request.time_limit && *request.time_limit <= Duration::zero()) {
    return fail(Errc::kInvalidArgument, "the mission's time limit must be above zero");
  }
  if (Status ok = validate(request.link_steps); !ok) {
    return ok;
  }
  return std::visit([](const auto& task) { return validate_task(task); }, request.task);
}

std::string_view task_name(const MissionTask& task) {
  struct Name {
    std::string_view operator()(const SearchMission&) const { return "search"; }
    std::string_view operator()(const GotoMission&) const { return "goto"; }
    std::string_view operator()(const ReturnMission&) const { return "return"; }
    std::string_view operator()(const ExploreMission&) const { return "explore"; }
    std::string_view operator()(const SurveyMission&) const { return "survey"; }
    std::string_view operator()(const LocaliseMission&) const { return "localise"; }
    std::string_view operator()(const RecogniseMission&) const { return "recognise"; }
  };
  return std::visit(Name{}, task);
}

std::string_view to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::kComplete: return "COMPLETE";
    case Outcome::kTargetFound: return "TARGET_FOUND";
    case Outcome::kNotFoundAreaCovered: return "NOT_FOUND_AREA_COVERED";
    case Outcome::kUnreachable: return "UNREACHABLE";
    case Outcome::kBoundReached: return "BOUND_REACHED";
    case Outcome::kTimeLimit: return "TIME_LIMIT";
    case Outcome::kUncertain: return "UNCERTAIN";
    case Outcome::kLost: return "LOST";
    case Outcome::kBattery: return "BATTERY";
    case Outcome::kLinkLost: return "LINK_LOST";
    case Outcome::kOperator: return "OPERATOR";
    case Outcome::kFault: return "FAULT";
  }
  return "FAULT";
}

std::string_view to_string(RecogniserKind kind) {
  switch (kind) {
    case RecogniserKind::kTemplate: return "template";
    case RecogniserKind::kFeatures: return "features";
    case RecogniserKind::kSolid: return "solid";
  }
  return "template";
}

std::string_view to_string(SearchMode mode) { return mode == SearchMode::kPaper ? "paper" : "plan"; }

std::string_view to_string(OnFound on_found) {
  switch (on_found) {
    case OnFound::kStop: return "stop";
    case OnFound::kApproach: return "approach";
    case OnFound::kContinue: return "continue";
  }
  return "stop";
}

std::string_view to_string(ExploreStrategy strategy) {
  switch (strategy) {
    case ExploreStrategy::kActive: return "active";
    case ExploreStrategy::kHorizon: return "horizon";
    case ExploreStrategy::kRoam: return "roam";
    case ExploreStrategy::kFrontier: return "frontier";
    case ExploreStrategy::kGain: return "gain";
    case ExploreStrategy::kTopological: return "topological";
    case ExploreStrategy::kTour: return "tour";
  }
  return "active";
}

std::string_view to_string(MissionState state) {
  switch (state) {
    case MissionState::kRunning: return "RUNNING";
    case MissionState::kPaused: return "PAUSED";
    case MissionState::kEnded: return "ENDED";
  }
  return "ENDED";
}

std::string_view to_string(RangeSource source) {
  switch (source) {
    case RangeSource::kNone: return "none";
    case RangeSource::kSonar: return "sonar";
    case RangeSource::kLidar: return "lidar";
    case RangeSource::kTriangulation: return "triangulation";
    case RangeSource::kFloor: return "floor";
  }
  return "none";
}

std::string_view to_string(ComponentState state) {
  switch (state) {
    case ComponentState::kCreated: return "CREATED";
    case ComponentState::kInactive: return "INACTIVE";
    case ComponentState::kActive: return "ACTIVE";
    case ComponentState::kError: return "ERROR";
  }
  return "ERROR";
}

std::string_view to_string(SettingEffect effect) {
  switch (effect) {
    case SettingEffect::kNow: return "NOW";
    case SettingEffect::kNextMission: return "NEXT_MISSION";
    case SettingEffect::kExchange: return "EXCHANGE";
    case SettingEffect::kRestart: return "RESTART";
  }
  return "RESTART";
}

std::string_view to_string(Severity severity) {
  switch (severity) {
    case Severity::kInfo: return "INFO";
    case Severity::kWarning: return "WARNING";
    case Severity::kError: return "ERROR";
    case Severity::kCritical: return "CRITICAL";
  }
  return "CRITICAL";
}

StreamClass stream_class(Topic topic) {
  switch (topic) {
    case Topic::kMission:
    case Topic::kEvent:
    case Topic::kDetection:
    case Topic::kSegments: return StreamClass::kReliable;
    default: return StreamClass::kLatest;
  }
}

std::string_view to_string(Topic topic) {
  switch (topic) {
    case Topic::kStatus: return "status";
    case Topic::kScan: return "scan";
    case Topic::kSonar: return "sonar";
    case Topic::kTiles: return "tiles";
    case Topic::kGrid: return "grid";
    case Topic::kImage: return "image";
    case Topic::kMission: return "mission";
    case Topic::kEvent: return "event";
    case Topic::kDetection: return "detection";
    case Topic::kSegments: return "segments";
    case Topic::kLines: return "lines";
    case Topic::kTopology: return "topology";
  }
  return "status";
}

}  // namespace seeker::api
