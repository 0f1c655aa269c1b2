// The calls about databases of landmarks.

#include "server/net/responder.hpp"

namespace seeker::server_net {
namespace {

void list_landmarks(const Responder& responder, api::RobotApi& robot) {
  robot.list_landmarks(reply_with<std::vector<api::LandmarkSummary>>(
      responder, [](const std::vector<api::LandmarkSummary>& databases, pb::Response& to) {
        for (const api::LandmarkSummary& database : databases) {
          wire::write(database, to.mutable_list_landmarks()->add_databases());
        }
      }));
}

void inspect_landmarks(const Responder& responder, api::RobotApi& robot, const pb::InspectLandmarksRequest& request) {
  with_name(responder, request.name(), [&] {
    robot.inspect_landmarks(
        request.name(), request.verify(),
        reply_with<api::LandmarkSummary>(responder, [](const api::LandmarkSummary& database, pb::Response& to) {
          wire::write(database, to.mutable_inspect_landmarks()->mutable_database());
        }));
  });
}

void get_landmarks(const Responder& responder, api::RobotApi& robot, const pb::GetLandmarksRequest& request) {
  with_name(responder, request.name(), [&] {
    robot.get_landmarks(request.name(),
                        reply_with<std::vector<api::LandmarkPoint>>(
                            responder, [](const std::vector<api::LandmarkPoint>& landmarks, pb::Response& to) {
                              for (const api::LandmarkPoint& landmark : landmarks) {
                                wire::write(landmark, to.mutable_get_landmarks()->add_landmarks());
                              }
                            }));
  });
}

void prune_landmarks(const Responder& responder, api::RobotApi& robot, const pb::PruneLandmarksRequest& request) {
  wire::Check check;
  const int min_views = check.natural("min_views", request.min_views());
  if (check.ok() && min_views == 0) {
    check.refuse("min_views", Errc::kInvalidArgument, "must be at least 1");
  }
  if (!check.ok()) {
    responder.answer_now(check.status());
    return;
  }
  with_name(responder, request.name(), [&] {
    robot.prune_landmarks(
        request.name(), min_views,
        reply_with<api::LandmarkSummary>(responder, [](const api::LandmarkSummary& database, pb::Response& to) {
          wire::write(database, to.mutable_prune_landmarks()->mutable_database());
        }));
  });
}

void revert_landmarks(const Responder& responder, api::RobotApi& robot, const std::string& name) {
  with_name(responder, name, [&] {
    robot.revert_landmarks(
        name, reply_with<api::LandmarkSummary>(responder, [](const api::LandmarkSummary& database, pb::Response& to) {
          wire::write(database, to.mutable_revert_landmarks()->mutable_database());
        }));
  });
}

}  // namespace

bool handle_landmark_call(const Responder& responder, Session& session, const pb::Request& request) {
  using R = pb::Request;
  api::RobotApi& robot = session.robot();
  switch (request.call_case()) {
    case R::kListLandmarks: list_landmarks(responder, robot); return true;
    case R::kInspectLandmarks: inspect_landmarks(responder, robot, request.inspect_landmarks()); return true;
    case R::kGetLandmarks: get_landmarks(responder, robot, request.get_landmarks()); return true;
    case R::kPruneLandmarks: prune_landmarks(responder, robot, request.prune_landmarks()); return true;
    case R::kRevertLandmarks: revert_landmarks(responder, robot, request.revert_landmarks().name()); return true;
    case R::kDeleteLandmarks:
      with_name(responder, request.delete_landmarks().name(),
                [&] { robot.delete_landmarks(request.delete_landmarks().name(), reply_empty(responder)); });
      return true;
    default: return false;
  }
}

}  // namespace seeker::server_net
