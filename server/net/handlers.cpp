#include "server/net/handlers.hpp"

#include <set>
#include <string>
#include <utility>

#include <boost/asio/post.hpp>

#include "common/wire/convert.hpp"
#include "common/wire/outcome.hpp"
#include "server/net/responder.hpp"

namespace seeker::server_net {
namespace {

/// Clients that speak this minor version stamp their commands, and say it where they mean to take or release something.
constexpr std::uint32_t kIntentMinor = 5;

/// Large maps leave in several responses.
void answer_tiles(const Responder& responder, const Result<api::TileUpdate>& result) {
  const SessionPtr to = responder.session.lock();
  if (!to) {
    return;
  }
  if (!result) {
    responder.answer_now(status_of(result));
    return;
  }
  const std::size_t n = result->tiles.size();
  const std::size_t parts = std::max<std::size_t>(1, (n + wire::kMaxTilesPerUpdate - 1) / wire::kMaxTilesPerUpdate);
  for (std::size_t part = 0; part < parts; ++part) {
    pb::Response response = responder.begin(*to, {});
    pb::GetTilesResponse* tiles = response.mutable_get_tiles();
    tiles->set_part(static_cast<std::uint32_t>(part + 1));
    tiles->set_parts(static_cast<std::uint32_t>(parts));
    tiles->mutable_update()->set_revision(result->revision);
    tiles->mutable_update()->set_map_epoch(result->map_epoch);
    const std::size_t end = std::min(n, (part + 1) * wire::kMaxTilesPerUpdate);
    for (std::size_t k = part * wire::kMaxTilesPerUpdate; k < end; ++k) {
      wire::write(result->tiles[k], tiles->mutable_update()->add_tiles());
    }
    to->respond(response, responder.call, part + 1 == parts);
  }
}

void get_tiles(const Responder& responder, Session& session, const pb::GetTilesRequest& request) {
  session.robot().get_tiles(request.since_revision(), [responder](Result<api::TileUpdate> result) {
    boost::asio::post(*responder.io, [responder, result = std::move(result)] { answer_tiles(responder, result); });
  });
}

void start_mission(const Responder& responder, Session& session, const pb::StartMissionRequest& request) {
  Result<api::MissionRequest> mission = wire::from_message<api::MissionRequest>(request.mission());
  const Status valid = mission ? api::validate(*mission) : status_of(mission);
  if (!valid) {
    responder.answer_now(valid);
    return;
  }
  session.robot().start_mission(
      *mission, reply_with<api::MissionAccepted>(responder, [](const api::MissionAccepted& accepted, pb::Response& to) {
        to.mutable_start_mission()->set_mission_id(accepted.id);
        wire::write(accepted.link_steps, *to.mutable_start_mission()->mutable_link_steps());
      }));
}

void command_mission(const Responder& responder, Session& session, const pb::CommandMissionRequest& request) {
  wire::Check check;
  api::MissionCommand command = api::MissionCommand::kStop;
  check.enumerator("command", request.command(), api::MissionCommand::kStop, command);
  if (!check.ok()) {
    responder.answer_now(check.status());
    return;
  }
  session.robot().command_mission(command, reply_empty(responder));
}

void command_lease(const Responder& responder, Session& session, const pb::CommandLeaseRequest& request) {
  wire::Check check;
  api::LeaseCommand command;
  check.enumerator("action", request.action(), api::LeaseAction::kRelease, command.action);
  command.intended = request.intended() || session.minor() < kIntentMinor;
  if (!check.ok()) {
    responder.answer_now(check.status());
    return;
  }
  session.robot().command_lease(
      command, reply_with<api::LeaseState>(responder, [](const api::LeaseState& lease, pb::Response& to) {
        wire::write(lease, to.mutable_command_lease()->mutable_lease());
      }));
}

void drive(const Responder& responder, Session& session, const pb::DriveRequest& request) {
  const Result<api::DriveCommand> command = wire::from_message<api::DriveCommand>(request.command());
  if (!command) {
    responder.answer_now(status_of(command));
    return;
  }
  const bool stamped = command->sent && session.time_synced();
  if (session.hub().robot.realtime && session.minor() >= kIntentMinor && !stamped) {
    responder.answer_now(fail(Errc::kRefused,
                              "a command with a time needs compared clocks: call time_sync in this session, and say "
                              "with sent_ns when the command was given"));
    return;
  }
  session.robot().drive(*command, reply_empty(responder));
}

/// An empty request releases nothing.
void set_estop(const Responder& responder, Session& session, const pb::Request& request) {
  const bool engaged = request.set_estop().engaged();
  if (!engaged && !request.set_estop().release() && session.minor() >= kIntentMinor) {
    responder.answer_now(fail(Errc::kInvalidArgument, "field 'release' must be set to release the emergency stop"));
    return;
  }
  session.once_calls().carry_out(request, reply_empty(responder),
                                 [&](const api::Reply<void>& reply) { session.robot().set_estop(engaged, reply); });
}

void stop(const Responder& responder, Session& session, const pb::Request& request) {
  session.once_calls().carry_out(request, reply_empty(responder),
                                 [&](const api::Reply<void>& reply) { session.robot().stop(reply); });
}

void grab_image(const Responder& responder, Session& session, const pb::GrabImageRequest& request) {
  if (request.camera().size() > wire::kMaxNameBytes) {
    responder.answer_now(fail(Errc::kInvalidArgument, "field 'camera' is longer than 64 bytes"));
    return;
  }
  session.robot().grab_image(request.camera(),
                             reply_with<api::ImageFrame>(responder, [](const api::ImageFrame& image, pb::Response& to) {
                               wire::write(image, to.mutable_grab_image()->mutable_image());
                             }));
}

Result<std::vector<wire::TopicWish>> read_wishes(const pb::SubscribeRequest& request) {
  wire::Check check;
  const auto n = static_cast<std::size_t>(request.topics_size());
  if (request.subscription_id() == 0 || n == 0 || n > api::kTopicCount) {
    return fail(Errc::kInvalidArgument,
                "a subscription needs an id above zero and 1 to " + std::to_string(api::kTopicCount) + " topics");
  }
  std::vector<wire::TopicWish> wishes(n);
  std::set<api::Topic> seen;
  for (std::size_t k = 0; k < n; ++k) {
    const auto scope = check.in("topics", k);
    const pb::TopicRequest& topic = request.topics(static_cast<int>(k));
    wire::read(topic, wishes[k].request, check);
    wishes[k].resume_stream_id = topic.resume_stream_id();
    if (!seen.insert(wishes[k].request.topic).second) {
      check.refuse("topic", Errc::kInvalidArgument, "is named twice");
    }
  }
  if (!check.ok()) {
    return tl::unexpected<Error>(check.status().error());
  }
  return wishes;
}

void subscribe(const Responder& responder, Session& session, const pb::SubscribeRequest& request) {
  Result<std::vector<wire::TopicWish>> wishes = read_wishes(request);
  if (!wishes) {
    responder.answer_now(status_of(wishes));
    return;
  }
  const std::size_t limit = session.hub().params.session.subscriptions;
  if (!session.streams().has(request.subscription_id()) && session.streams().subscriptions() >= limit) {
    responder.answer_now(fail(Errc::kTooLarge, "a session has at most " + std::to_string(limit) +
                                                   " subscriptions; ask for several topics in one"));
    return;
  }
  pb::Response response = responder.begin(session, {});
  // The answer goes into the outbox, which leaves before any stream: the client knows its positions first.
  for (pb::TopicReply& reply : session.streams().subscribe(request.subscription_id(), *wishes)) {
    *response.mutable_subscribe()->add_topics() = std::move(reply);
  }
  session.respond(response, responder.call);
  for (const wire::TopicWish& wish : *wishes) {
    if (const api::UpdatePtr& newest = session.hub().newest.at(static_cast<std::size_t>(wish.request.topic))) {
      session.offer(newest->topic, newest->sequence, wire::encode_body(*newest));
    }
  }
  session.wake();
}

void unsubscribe(const Responder& responder, Session& session, const pb::UnsubscribeRequest& request) {
  const bool known = session.streams().unsubscribe(request.subscription_id());
  responder.answer_now(known ? Status{} : fail(Errc::kNotFound, "no subscription has this id"));
}

void time_sync(const Responder& responder, Session& session) {
  pb::Response response = responder.begin(session, {});
  session.note_time_sync();
  response.mutable_time_sync()->set_realtime(session.hub().robot.realtime);
  response.mutable_time_sync()->set_unix_ns(net::unix_ns_now());
  session.respond(response, responder.call);
}

void get_detections(const Responder& responder, Session& session) {
  session.robot().get_detections(reply_with<std::vector<api::Detection>>(
      responder, [](const std::vector<api::Detection>& detections, pb::Response& to) {
        for (const api::Detection& detection : detections) {
          wire::write(detection, to.mutable_get_detections()->add_detections());
        }
      }));
}

/// Calls without argument that read one value.
void read_call(const Responder& responder, Session& session, const pb::Request& request) {
  using R = pb::Request;
  api::RobotApi& robot = session.robot();
  switch (request.call_case()) {
    case R::kGetInfo:
      return robot.get_info(reply_with<api::RobotInfo>(responder, [](const auto& value, pb::Response& to) {
        wire::write(value, to.mutable_get_info()->mutable_info());
      }));
    case R::kGetStatus:
      return robot.get_status(reply_with<api::RobotStatus>(responder, [](const auto& value, pb::Response& to) {
        wire::write(value, to.mutable_get_status()->mutable_robot());
      }));
    case R::kGetMission:
      return robot.get_mission(reply_with<api::MissionStatus>(responder, [](const auto& value, pb::Response& to) {
        wire::write(value, to.mutable_get_mission()->mutable_mission());
      }));
    case R::kGetGrid:
      return robot.get_grid(reply_with<api::GridReport>(responder, [](const auto& value, pb::Response& to) {
        wire::write(value, to.mutable_get_grid()->mutable_grid());
      }));
    case R::kGetTrajectory:
      return robot.get_trajectory(
          reply_with<std::vector<api::StampedPose>>(responder, [](const auto& value, pb::Response& to) {
            wire::write(value, to.mutable_get_trajectory()->mutable_poses());
          }));
    case R::kGetDetections: return get_detections(responder, session);
    default: return responder.answer_now(fail(Errc::kUnsupportedVersion, "this robot does not know the call"));
  }
}

}  // namespace

void handle(const SessionPtr& session, const pb::Request& request, RobotTime received) {
  using R = pb::Request;
  const Responder responder{session, session->hub().io, request.header(),
                            static_cast<wire::CallNumber>(request.call_case()), received};
  Session& s = *session;
  switch (request.call_case()) {
    case R::kStop: return stop(responder, s, request);
    case R::kSetEstop: return set_estop(responder, s, request);
    case R::kDrive: return drive(responder, s, request.drive());
    case R::kStartMission: return start_mission(responder, s, request.start_mission());
    case R::kCommandMission: return command_mission(responder, s, request.command_mission());
    case R::kCommandLease: return command_lease(responder, s, request.command_lease());
    case R::kGetTiles: return get_tiles(responder, s, request.get_tiles());
    case R::kGrabImage: return grab_image(responder, s, request.grab_image());
    case R::kSubscribe: return subscribe(responder, s, request.subscribe());
    case R::kUnsubscribe: return unsubscribe(responder, s, request.unsubscribe());
    case R::kTimeSync: return time_sync(responder, s);
    default: break;
  }
  if (!handle_map_call(responder, s, request) && !handle_landmark_call(responder, s, request) &&
      !handle_component_call(responder, s, request) && !handle_transfer_call(responder, s, request) &&
      !handle_diagnosis_call(responder, s, request)) {
    read_call(responder, s, request);
  }
}

}  // namespace seeker::server_net
