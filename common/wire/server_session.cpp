#include "common/wire/server_session.hpp"

#include <algorithm>

#include "common/wire/convert.hpp"
#include "common/wire/envelope.hpp"
#include "common/wire/outcome.hpp"

namespace seeker::wire {
namespace {

/// Pressing the stop key as fast as one likes stays below this.
constexpr double kUrgentPerSecond = 50.0;
constexpr double kUrgentBurst = 100.0;

ServerStep end_with(pb::Close::Reason reason, std::string text) {
  ServerStep step;
  step.end = Ending{reason, std::move(text), false, true};
  return step;
}

}  // namespace

bool is_client_name(std::string_view name) {
  return !name.empty() && name.size() <= kMaxNameBytes &&
         std::all_of(name.begin(), name.end(), [](char c) { return c > ' ' && c < 0x7f; });
}

bool agrees_with_certificate(std::string_view name, std::string_view certified) {
  return certified.empty() || name == certified ||
         (name.starts_with(certified) && name.size() > certified.size() && name[certified.size()] == '/');
}

std::string certified_client_name(std::string_view certified, std::string_view program) {
  if (agrees_with_certificate(program, certified)) {
    return std::string(program);
  }
  return (std::string(certified) + "/" + std::string(program)).substr(0, kMaxNameBytes);
}

bool is_urgent(const pb::Request& request) {
  return request.call_case() == pb::Request::kStop || (request.has_set_estop() && request.set_estop().engaged());
}

// No default: a new call that is forgotten here does not compile.
api::Role required_role(const pb::Request& request) {
  switch (request.call_case()) {
    case pb::Request::kRestartComponent:
    case pb::Request::kStartMission:
    case pb::Request::kCommandMission:
    case pb::Request::kCommandLease:
    case pb::Request::kSaveMap:
    case pb::Request::kLoadMap:
    case pb::Request::kDeleteMap:
    case pb::Request::kUploadMap:
    case pb::Request::kBeginUpload:
    case pb::Request::kUploadPiece:
    case pb::Request::kFinishUpload:
    case pb::Request::kPruneLandmarks:
    case pb::Request::kDeleteLandmarks:
    case pb::Request::kRevertLandmarks:
    case pb::Request::kRelocalise:
    case pb::Request::kSwitchComponent:
    case pb::Request::kExchangeComponent:
    case pb::Request::kSetSettings:
    case pb::Request::kDrive: return api::Role::kOperator;
    case pb::Request::kSetEstop: return request.set_estop().engaged() ? api::Role::kObserver : api::Role::kOperator;
    case pb::Request::kGetInfo:
    case pb::Request::kGetStatus:
    case pb::Request::kListComponents:
    case pb::Request::kGetMission:
    case pb::Request::kStop:
    case pb::Request::kGetTiles:
    case pb::Request::kGetGrid:
    case pb::Request::kGetDetections:
    case pb::Request::kGetTrajectory:
    case pb::Request::kGrabImage:
    case pb::Request::kSubscribe:
    case pb::Request::kUnsubscribe:
    case pb::Request::kTimeSync:
    case pb::Request::kListMaps:
    case pb::Request::kInspectMap:
    case pb::Request::kDownloadMap:
    case pb::Request::kReadFile:
    case pb::Request::kGetSegments:
    case pb::Request::kListLandmarks:
    case pb::Request::kInspectLandmarks:
    case pb::Request::kGetLandmarks:
    case pb::Request::kGetSettings:
    case pb::Request::kGetDiagnosis:
    case pb::Request::kGetAudit:
    case pb::Request::CALL_NOT_SET: return api::Role::kObserver;
  }
  return api::Role::kAdmin;  // a number that this version does not know
}

void begin_response(const pb::RequestHeader& request, const std::string& robot_id, RobotTime received, RobotTime now,
                    pb::Response& response) {
  pb::ResponseHeader* header = response.mutable_header();
  header->set_request_id(request.request_id());
  header->set_robot_id(robot_id);
  header->set_client_time_ns(request.client_time_ns());
  header->set_robot_received_time_ns(received.time_since_epoch().count());
  header->set_robot_sent_time_ns(now.time_since_epoch().count());
}

ServerSession::ServerSession(ServerSessionParams params, WallTime now)
    : params_(std::move(params)),
      liveness_(params_.liveness, now),
      tokens_(params_.requests_per_s, params_.request_burst, now),
      urgent_tokens_(kUrgentPerSecond, kUrgentBurst, now),
      started_(now),
      last_request_(now) {}

void ServerSession::answered() {
  if (in_flight_ > 0) {
    --in_flight_;
  }
}

ServerStep ServerSession::on_payload(std::string_view payload, WallTime now, RobotTime robot_now) {
  Result<pb::Envelope> envelope = parse_envelope(payload);
  if (!envelope) {
    return end_with(pb::Close::REASON_PROTOCOL_ERROR, envelope.error().message);
  }
  liveness_.on_received(now);
  if (!open_) {
    return envelope->has_hello() ? on_hello(envelope->hello())
                                 : end_with(pb::Close::REASON_PROTOCOL_ERROR, "say hello first");
  }
  switch (envelope->body_case()) {
    case pb::Envelope::kRequest: return on_request(*envelope->mutable_request(), now, robot_now);
    case pb::Envelope::kHeartbeat: return {};
    case pb::Envelope::kClose: {
      ServerStep step;
      const bool goodbye = envelope->close().reason() == pb::Close::REASON_GOODBYE;
      step.end =
          Ending{envelope->close().reason(), goodbye ? "goodbye" : "the client closed the session", goodbye, false};
      return step;
    }
    default: return end_with(pb::Close::REASON_PROTOCOL_ERROR, "a client may not send this kind of message here");
  }
}

pb::HelloReply ServerSession::reply_base() const {
  pb::HelloReply reply;
  reply.set_protocol_major(api::kProtocolMajor);
  reply.set_protocol_minor(api::kProtocolMinor);
  write(params_.robot, reply.mutable_robot());
  return reply;
}

ServerStep ServerSession::refuse_hello(pb::HelloReply::Status status, std::string message) const {
  ServerStep step;
  pb::HelloReply reply = reply_base();
  reply.set_status(status);
  reply.set_message(message);
  *step.send.emplace().mutable_hello_reply() = std::move(reply);
  step.end = Ending{pb::Close::REASON_PROTOCOL_ERROR, std::move(message), false, false};
  return step;
}

ServerStep ServerSession::on_hello(const pb::Hello& hello) {
  if (hello.protocol_major() != api::kProtocolMajor) {
    return refuse_hello(pb::HelloReply::STATUS_UNSUPPORTED_VERSION,
                        "the robot speaks protocol " + std::to_string(api::kProtocolMajor) + "." +
                            std::to_string(api::kProtocolMinor) + ", the client " +
                            std::to_string(hello.protocol_major()) + "." + std::to_string(hello.protocol_minor()) +
                            "; update the older of both");
  }
  if (!is_client_name(hello.client_name()) || !pb::Role_IsValid(hello.role()) || hello.role() == pb::ROLE_UNSPECIFIED) {
    return refuse_hello(pb::HelloReply::STATUS_INVALID_ARGUMENT,
                        "hello needs a role and a client name of 1 to 64 printable characters without spaces");
  }
  if (!agrees_with_certificate(hello.client_name(), params_.certified_name)) {
    return refuse_hello(pb::HelloReply::STATUS_INVALID_ARGUMENT,
                        "the certificate is of '" + params_.certified_name + "', the client calls itself '" +
                            hello.client_name() + "'; its name must be '" + params_.certified_name +
                            "' or begin with '" + params_.certified_name + "/'");
  }
  if (!hello.robot_id().empty() && hello.robot_id() != params_.robot.robot_id) {
    return refuse_hello(pb::HelloReply::STATUS_NOT_FOUND,
                        "this robot is '" + params_.robot.robot_id + "'; check the address of the one you look for");
  }
  if (params_.full) {
    return refuse_hello(pb::HelloReply::STATUS_BUSY, "the robot has no session left; close another client");
  }
  if (params_.stuck) {
    return refuse_hello(pb::HelloReply::STATUS_NOT_READY,
                        "the robot's control loop is stuck and its base has stopped; restart seekerd, or try again");
  }
  open_ = true;
  instance_ = hello.instance();
  const auto asked = static_cast<api::Role>(hello.role() - 1);
  caller_ = {hello.client_name(), std::min(asked, params_.max_role)};
  ServerStep step;
  step.opened = true;
  pb::HelloReply reply = reply_base();
  reply.set_status(pb::HelloReply::STATUS_OK);
  minor_ = std::min(hello.protocol_minor(), api::kProtocolMinor);
  reply.set_protocol_minor(minor_);
  reply.set_role(static_cast<pb::Role>(wire_enum(caller_.role)));
  reply.set_stream_id(params_.stream_id);
  reply.set_heartbeat_period_ns(params_.liveness.heartbeat.count());
  reply.set_lost_after_ns(params_.liveness.lost_after.count());
  *step.send.emplace().mutable_hello_reply() = std::move(reply);
  return step;
}

ServerStep ServerSession::refuse_request(pb::Request& request, RobotTime robot_now, pb::CommonError::Code code,
                                         const std::string& message) {
  ++refused_total_;
  ServerStep step;
  pb::Response* response = step.send.emplace().mutable_response();
  begin_response(request.header(), params_.robot.robot_id, robot_now, robot_now, *response);
  set_common_error(*response, code, message);
  step.refused = std::move(request);
  return step;
}

ServerStep ServerSession::on_request(pb::Request& request, WallTime now, RobotTime robot_now) {
  last_request_ = now;
  if (request.header().request_id() == 0) {
    return end_with(pb::Close::REASON_PROTOCOL_ERROR, "a request needs a header with an id above zero");
  }
  const bool urgent = is_urgent(request);
  const bool allowed = urgent ? urgent_tokens_.take(now) : in_flight_ < params_.in_flight && tokens_.take(now);
  if (!allowed) {
    if (++refused_in_a_row_ > params_.refused_requests) {
      return end_with(pb::Close::REASON_FLOODING, "the client keeps sending more requests than allowed");
    }
    return refuse_request(request, robot_now, pb::CommonError::CODE_RATE_LIMITED,
                          "too many requests per second or in flight; wait for answers and repeat");
  }
  refused_in_a_row_ = 0;
  const std::string& meant = request.header().robot_id();
  if (!meant.empty() && meant != params_.robot.robot_id) {
    return refuse_request(request, robot_now, pb::CommonError::CODE_WRONG_ROBOT,
                          "this robot is '" + params_.robot.robot_id + "'");
  }
  if (request.call_case() == pb::Request::CALL_NOT_SET) {
    return refuse_request(request, robot_now, pb::CommonError::CODE_UNSUPPORTED_VERSION,
                          "this robot does not know the call; it speaks protocol " +
                              std::to_string(api::kProtocolMajor) + "." + std::to_string(api::kProtocolMinor));
  }
  if (caller_.role < required_role(request)) {
    return refuse_request(request, robot_now, pb::CommonError::CODE_REFUSED,
                          params_.certified_name.empty() || caller_.role < params_.max_role
                              ? "an observer may not do this; connect as operator"
                              : "the certificate of '" + params_.certified_name +
                                    "' is an observer's and does not "
                                    "allow this; have one issued with --role operator");
  }
  ++in_flight_;
  ServerStep step;
  step.request = std::move(request);
  return step;
}

ServerStep ServerSession::on_tick(WallTime now, RobotTime robot_now, std::uint64_t loop_pass, bool has_subscriptions) {
  if (!open_) {
    return now - started_ >= params_.hello_timeout ? end_with(pb::Close::REASON_SILENT, "no hello came in time")
                                                   : ServerStep{};
  }
  if (liveness_.lost(now)) {
    return end_with(pb::Close::REASON_SILENT, "no frame was received from the client for " +
                                                  std::to_string(to_seconds(params_.liveness.lost_after)) + " s");
  }
  if (params_.idle_limit > Duration::zero() && !has_subscriptions && now - last_request_ >= params_.idle_limit) {
    return end_with(pb::Close::REASON_IDLE, "the client asked for nothing for a long time");
  }
  ServerStep step;
  if (liveness_.heartbeat_due(now) && beat_pass_ != loop_pass) {
    beat_pass_ = loop_pass;
    pb::Heartbeat* heartbeat = step.send.emplace().mutable_heartbeat();
    heartbeat->set_loop_pass(loop_pass);
    heartbeat->set_sender_time_ns(now.time_since_epoch().count());
    heartbeat->set_robot_time_ns(robot_now.time_since_epoch().count());
  }
  return step;
}

}  // namespace seeker::wire
