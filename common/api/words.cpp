// The words by which files, logs and people name the values of this folder.

#include "common/api/robot_api.hpp"

namespace seeker::api {

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

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::kOk: return "OK";
    case Verdict::kWarning: return "WARNING";
    case Verdict::kFailed: return "FAILED";
  }
  return "FAILED";
}

std::string_view to_string(Role role) {
  switch (role) {
    case Role::kObserver: return "observer";
    case Role::kOperator: return "operator";
    case Role::kAdmin: return "admin";
  }
  return "observer";
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
