#include "server/net/audit_text.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include "common/wire/convert.hpp"

namespace seeker::server_net {
namespace {

namespace pb = ::seeker::v1;

/// "MAP_USE_CONTINUE" without its prefix, in small letters: "continue". A number that is no enumerator has no name.
std::string word(std::string_view prefix, const std::string& enumerator) {
  std::string text = enumerator.starts_with(prefix) ? enumerator.substr(prefix.size()) : std::string("?");
  std::transform(text.begin(), text.end(), text.begin(), [](char c) {
    return c == '_' ? '-' : c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return text;
}

std::string number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2f", value);
  return text.data();
}

template <class Names>
std::string targets(const Names& all) {
  std::string text;
  for (const auto& target : all) {
    text += " '" + target.name() + "'";
  }
  return text;
}

std::string essentials(const pb::MissionRequest& mission) {
  const std::string named = "mission '" + mission.id() + "': ";
  switch (mission.task_case()) {
    case pb::MissionRequest::kSearch: return named + "search for" + targets(mission.search().targets());
    case pb::MissionRequest::kGoTo:
      return named + "goto over " + std::to_string(mission.go_to().waypoints().x_m_size()) + " waypoints";
    case pb::MissionRequest::kReturnHome: return named + "return";
    case pb::MissionRequest::kExplore: return named + "explore";
    case pb::MissionRequest::kSurvey: return named + "survey into '" + mission.survey().landmarks() + "'";
    case pb::MissionRequest::kLocalise: return named + "localise by '" + mission.localise().landmarks() + "'";
    case pb::MissionRequest::kRecognise: return named + "recognise" + targets(mission.recognise().targets());
    case pb::MissionRequest::TASK_NOT_SET: break;
  }
  return named + "?";
}

std::string essentials(const pb::CommandLeaseRequest& request) {
  return word("LEASE_ACTION_", pb::LeaseAction_Name(request.action())) + (request.intended() ? ", intended" : "");
}

std::string essentials(const pb::DriveRequest& request) {
  const pb::Twist2& velocity = request.command().velocity();
  return number(velocity.v_m_s()) + " m/s, " + number(velocity.omega_rad_s()) + " rad/s";
}

std::string essentials(const pb::RelocaliseRequest& request) {
  const pb::Pose2& pose = request.map_t_base();
  return request.has_map_t_base()
             ? "near " + number(pose.x_m()) + " m, " + number(pose.y_m()) + " m, " + number(pose.theta_rad()) + " rad"
             : "in the whole map";
}

std::string essentials(const pb::SetSettingsRequest& request) {
  std::string text = "'" + request.component() + "'";
  for (const std::string& assignment : request.assignments()) {
    text += " " + assignment;
  }
  return text;
}

std::string named(const std::string& name, bool replace = false) {
  return "'" + name + "'" + (replace ? ", replacing" : "");
}

std::string essentials(const pb::FinishUploadRequest& request) {
  return word("FILE_KIND_", pb::FileKind_Name(request.kind())) + " " + named(request.name(), request.replace()) +
         (request.check_only() ? ", only to be checked" : "");
}

// No default: a new call that is forgotten here does not compile.
std::optional<std::string> raw_essentials(const pb::Request& request) {
  using R = pb::Request;
  switch (request.call_case()) {
    case R::kStop: return "";
    case R::kSetEstop: return request.set_estop().engaged() ? "engage" : "release";
    case R::kCommandLease: return essentials(request.command_lease());
    case R::kDrive: return essentials(request.drive());
    case R::kStartMission: return essentials(request.start_mission().mission());
    case R::kCommandMission:
      return word("MISSION_COMMAND_", pb::MissionCommand_Name(request.command_mission().command()));
    case R::kRestartComponent: return named(request.restart_component().name());
    case R::kSwitchComponent:
      return named(request.switch_component().name()) + (request.switch_component().active() ? " on" : " off");
    case R::kExchangeComponent:
      return named(request.exchange_component().name()) + " for " + named(request.exchange_component().type());
    case R::kSetSettings: return essentials(request.set_settings());
    case R::kSaveMap: return named(request.save_map().name(), request.save_map().replace());
    case R::kLoadMap:
      return named(request.load_map().name()) + " to " + word("MAP_USE_", pb::MapUse_Name(request.load_map().use()));
    case R::kDeleteMap: return named(request.delete_map().name());
    case R::kUploadMap:
      return named(request.upload_map().name(), request.upload_map().replace()) + ", " +
             std::to_string(request.upload_map().file().size()) + " bytes" +
             (request.upload_map().check_only() ? ", only to be checked" : "");
    case R::kFinishUpload: return essentials(request.finish_upload());
    case R::kRelocalise: return essentials(request.relocalise());
    case R::kPruneLandmarks:
      return named(request.prune_landmarks().name()) + " below " +
             std::to_string(request.prune_landmarks().min_views()) + " views";
    case R::kDeleteLandmarks: return named(request.delete_landmarks().name());
    case R::kRevertLandmarks: return named(request.revert_landmarks().name());
    case R::kGetInfo:
    case R::kGetStatus:
    case R::kListComponents:
    case R::kGetMission:
    case R::kGetTiles:
    case R::kGetGrid:
    case R::kGetDetections:
    case R::kGetTrajectory:
    case R::kGrabImage:
    case R::kSubscribe:
    case R::kUnsubscribe:
    case R::kTimeSync:
    case R::kListMaps:
    case R::kInspectMap:
    case R::kDownloadMap:
    case R::kGetSegments:
    case R::kListLandmarks:
    case R::kInspectLandmarks:
    case R::kGetLandmarks:
    case R::kGetSettings:
    case R::kGetDiagnosis:
    case R::kGetAudit:
    case R::kBeginUpload:  // these bring bytes, which FinishUpload takes into use
    case R::kUploadPiece:
    case R::kReadFile:
    case R::CALL_NOT_SET: return std::nullopt;
  }
  return std::nullopt;  // a number that this version does not know
}

}  // namespace

std::optional<std::string> audit_essentials(const pb::Request& request) {
  std::optional<std::string> text = raw_essentials(request);
  if (text) {
    text = wire::one_line(*text, api::kMaxAuditEssentials_bytes);
  }
  return text;
}

}  // namespace seeker::server_net
