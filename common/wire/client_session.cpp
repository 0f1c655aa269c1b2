#include "common/wire/client_session.hpp"

#include "common/wire/convert.hpp"
#include "common/wire/envelope.hpp"
#include "common/wire/outcome.hpp"

namespace seeker::wire {
namespace {

/// What a robot may ask for; anything else is a fault in it.
constexpr Duration kMinHeartbeat = std::chrono::milliseconds(1);
constexpr Duration kMaxHeartbeat = std::chrono::minutes(10);

ClientStep end_with(Errc code, std::string message, bool final_end = false) {
  ClientStep step;
  step.end = Error{code, std::move(message)};
  step.final_end = final_end;
  return step;
}

/// Large maps come in several responses.
bool more_follow(const pb::Response& response) {
  return (response.has_get_tiles() && response.get_tiles().part() < response.get_tiles().parts()) ||
         (response.has_get_segments() && response.get_segments().part() < response.get_segments().parts());
}

Errc code_of(pb::HelloReply::Status status) {
  Errc code = Errc::kInternal;
  return errc_of(pb::HelloReply::Status_Name(status), code) ? code : Errc::kInternal;
}

}  // namespace

ClientSession::ClientSession(ClientSessionParams params, WallTime now)
    : params_(std::move(params)), liveness_(params_.liveness, now) {}

pb::Envelope ClientSession::hello() const {
  pb::Envelope envelope;
  pb::Hello* hello = envelope.mutable_hello();
  hello->set_protocol_major(api::kProtocolMajor);
  hello->set_protocol_minor(api::kProtocolMinor);
  hello->set_client_name(params_.client_name);
  hello->set_instance(params_.instance);
  hello->set_role(static_cast<pb::Role>(wire_enum(params_.role)));
  hello->set_robot_id(params_.robot_id);
  return envelope;
}

pb::Envelope ClientSession::call(pb::Request request, WallTime now, Duration timeout, Answer answer) {
  pb::RequestHeader* header = request.mutable_header();
  header->set_request_id(next_request_++);
  header->set_client_name(params_.client_name);
  header->set_robot_id(robot_.robot_id);
  header->set_client_time_ns(now.time_since_epoch().count());
  Pending pending{static_cast<int>(request.call_case()), now + timeout, timeout, std::move(answer), {}};
  pending_.emplace(header->request_id(), std::move(pending));
  pb::Envelope envelope;
  *envelope.mutable_request() = std::move(request);
  return envelope;
}

ClientStep ClientSession::on_payload(std::string_view payload, WallTime now) {
  Result<pb::Envelope> envelope = parse_envelope(payload);
  if (!envelope) {
    return end_with(Errc::kParse, "what answers there is not a robot of this protocol: " + envelope.error().message);
  }
  liveness_.on_received(now);
  if (envelope->has_close()) {
    // Also when it was replaced: its instance is nobody else's, so that was an older connection of its own, which the
    // network held back.
    return end_with(Errc::kLinkLost, "the robot closed the session: " + envelope->close().message());
  }
  if (envelope->has_hello_reply() != !open_) {
    return end_with(Errc::kParse, "the robot did not answer hello with hello");
  }
  switch (envelope->body_case()) {
    case pb::Envelope::kHelloReply: return on_hello(envelope->hello_reply());
    case pb::Envelope::kHeartbeat: return {};
    case pb::Envelope::kResponse: return on_response(*envelope->mutable_response(), now);
    case pb::Envelope::kStreamUpdate: {
      ClientStep step;
      step.update = std::move(*envelope->mutable_stream_update());
      return step;
    }
    default: return end_with(Errc::kParse, "the robot sent a kind of message that only clients send");
  }
}

ClientStep ClientSession::on_hello(const pb::HelloReply& reply) {
  if (reply.status() != pb::HelloReply::STATUS_OK) {
    const bool wait =
        reply.status() == pb::HelloReply::STATUS_BUSY || reply.status() == pb::HelloReply::STATUS_NOT_READY;
    return end_with(code_of(reply.status()), reply.message(), !wait);
  }
  if (reply.protocol_major() != api::kProtocolMajor) {
    return end_with(Errc::kUnsupportedVersion,
                    "the robot speaks protocol " + std::to_string(reply.protocol_major()) + ", this program " +
                        std::to_string(api::kProtocolMajor) + "; update the older of both",
                    true);
  }
  Result<api::RobotInfo> robot = from_message<api::RobotInfo>(reply.robot());
  const Duration heartbeat(reply.heartbeat_period_ns());
  const Duration lost_after(reply.lost_after_ns());
  if (!robot || heartbeat < kMinHeartbeat || heartbeat > kMaxHeartbeat || lost_after < heartbeat ||
      lost_after > 10 * kMaxHeartbeat || !pb::Role_IsValid(reply.role()) || reply.role() == pb::ROLE_UNSPECIFIED) {
    return end_with(Errc::kParse, "the robot's hello is not valid", true);
  }
  robot_ = std::move(*robot);
  role_ = static_cast<api::Role>(reply.role() - 1);
  stream_id_ = reply.stream_id();
  // The robot loses us after lost_after: speak at least as often as it asks for.
  params_.liveness.heartbeat = std::min(params_.liveness.heartbeat, heartbeat);
  params_.liveness.lost_after = lost_after;
  liveness_.set_params(params_.liveness);
  open_ = true;
  ClientStep step;
  step.opened = true;
  return step;
}

ClientStep ClientSession::on_response(pb::Response& response, WallTime now) {
  const auto found = pending_.find(response.header().request_id());
  if (found == pending_.end()) {
    return {};  // its time was over
  }
  Pending& pending = found->second;
  const bool failed = response.header().error().code() != pb::CommonError::CODE_OK;
  if (!failed && static_cast<int>(response.result_case()) != pending.call) {
    return end_with(Errc::kParse, "the robot answered another call than the one that was made");
  }
  const bool more = more_follow(response);
  pending.parts.push_back(std::move(response));
  if (more && pending.parts.size() < kMaxTileParts) {
    pending.deadline = now + pending.timeout;
    return {};
  }
  const Answer answer = std::move(pending.answer);
  std::vector<pb::Response> parts = std::move(pending.parts);
  pending_.erase(found);
  answer(std::move(parts));
  return {};
}

ClientStep ClientSession::on_tick(WallTime now) {
  std::vector<Pending> late;
  for (auto it = pending_.begin(); it != pending_.end();) {
    if (now >= it->second.deadline) {
      late.push_back(std::move(it->second));
      it = pending_.erase(it);
    } else {
      ++it;
    }
  }
  for (const Pending& pending : late) {
    pending.answer(fail(Errc::kTimeout, "the robot did not answer '" + call_name(pending.call) + "' in " +
                                            std::to_string(to_seconds(pending.timeout)) +
                                            " s; check the link, or allow more time"));
  }
  if (liveness_.lost(now)) {
    return end_with(Errc::kLinkLost, "no frame was received from the robot for " +
                                         std::to_string(to_seconds(params_.liveness.lost_after)) +
                                         " s; check network and robot");
  }
  ClientStep step;
  if (open_ && liveness_.heartbeat_due(now)) {
    step.send.emplace().mutable_heartbeat()->set_sender_time_ns(now.time_since_epoch().count());
  }
  return step;
}

void ClientSession::fail_all(const Error& error) {
  std::map<std::uint64_t, Pending> pending;
  pending.swap(pending_);
  for (const auto& [id, one] : pending) {
    one.answer(tl::unexpected<Error>(error));
  }
}

}  // namespace seeker::wire
