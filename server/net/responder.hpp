/// \file
/// Responses of handlers: the robot replies on any thread, the response is made and sent on the network thread.
#pragma once

#include <memory>
#include <utility>

#include <boost/asio/post.hpp>

#include "common/wire/convert.hpp"
#include "common/wire/outcome.hpp"
#include "server/net/session.hpp"

namespace seeker::server_net {

namespace pb = ::seeker::v1;
using SessionPtr = std::shared_ptr<Session>;

/// All that a response needs, valid on any thread and after the end of the session.
struct Responder {
  std::weak_ptr<Session> session;
  std::shared_ptr<boost::asio::io_context> io;
  pb::RequestHeader header;
  wire::CallNumber call = 0;
  RobotTime received;

  /// Begins a response; to be called on the network thread.
  [[nodiscard]] pb::Response begin(const Session& to, const Status& outcome) const {
    pb::Response response;
    wire::begin_response(header, to.hub().robot.robot_id, received, to.hub().robot_now(), response);
    wire::set_outcome(response, call, outcome);
    return response;
  }
  void answer_now(const Status& outcome) const {
    if (const SessionPtr to = session.lock()) {
      to->respond(begin(*to, outcome), call);
    }
  }
};

inline Status status_of(const Status& result) { return result; }
template <class T>
Status status_of(const Result<T>& result) {
  return result ? Status{} : Status(tl::unexpected<Error>(result.error()));
}

/// A reply, for a call of the robot, that sends the response; `fill` writes the value into it on the network thread.
template <class T, class Fill>
api::Reply<T> reply_with(const Responder& responder, Fill fill) {
  return [responder, fill](Result<T> result) {
    boost::asio::post(*responder.io, [responder, fill, result = std::move(result)] {
      if (const SessionPtr to = responder.session.lock()) {
        pb::Response response = responder.begin(*to, status_of(result));
        if constexpr (!std::is_void_v<T>) {
          if (result) {
            fill(*result, response);
          }
        } else {
          static_cast<void>(fill);
        }
        to->respond(response, responder.call);
      }
    });
  };
}

inline api::Reply<void> reply_empty(const Responder& responder) {
  return reply_with<void>(responder, [] {});
}

/// Calls `go` when `name` is a valid name of a map or a database of landmarks; else responds with the error.
template <class Go>
void with_name(const Responder& responder, const std::string& name, Go go) {
  if (const Status ok = validate_map_name(name); !ok) {
    responder.answer_now(ok);
  } else {
    go();
  }
}

/// Handles calls about maps of segments (map_handlers.cpp), landmarks (landmark_handlers.cpp), components
/// (component_handlers.cpp), files in pieces (transfer_handlers.cpp), and what was checked and recorded
/// (diagnosis_handlers.cpp); false when the request is none of them.
[[nodiscard]] bool handle_map_call(const Responder& responder, Session& session, const pb::Request& request);
[[nodiscard]] bool handle_landmark_call(const Responder& responder, Session& session, const pb::Request& request);
[[nodiscard]] bool handle_component_call(const Responder& responder, Session& session, const pb::Request& request);
[[nodiscard]] bool handle_transfer_call(const Responder& responder, Session& session, const pb::Request& request);
[[nodiscard]] bool handle_diagnosis_call(const Responder& responder, Session& session, const pb::Request& request);

}  // namespace seeker::server_net
