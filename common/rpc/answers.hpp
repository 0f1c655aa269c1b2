/// \file
/// Conversion of the responses of a call to the reply of its caller.
#pragma once

#include <utility>
#include <vector>

#include "common/api/robot_api.hpp"
#include "common/wire/client_session.hpp"
#include "common/wire/convert.hpp"
#include "common/wire/outcome.hpp"

namespace seeker::rpc {

namespace pb = ::seeker::v1;
using Responses = std::vector<pb::Response>;

/// The handler of responses for a call that returns no value.
inline wire::ClientSession::Answer empty_answer(api::Reply<void> reply) {
  return [reply = std::move(reply)](Result<Responses> responses) {
    reply(responses ? wire::outcome(responses->front()) : Status(tl::unexpected<Error>(responses.error())));
  };
}

/// The handler of responses for a call that returns a value, which `read` takes out of successful responses.
template <class T, class Read>
wire::ClientSession::Answer value_answer(api::Reply<T> reply, Read read) {
  return [reply = std::move(reply), read](Result<Responses> responses) {
    if (!responses) {
      reply(tl::unexpected<Error>(responses.error()));
      return;
    }
    for (const pb::Response& response : *responses) {
      if (const Status ok = wire::outcome(response); !ok) {
        reply(tl::unexpected<Error>(ok.error()));
        return;
      }
    }
    Result<T> value = read(*responses);
    reply(value ? std::move(value) : fail_with_context("the robot's answer is not valid", value.error()));
  };
}

template <class T>
Result<std::vector<T>> read_list(const auto& messages, std::size_t limit) {
  if (static_cast<std::size_t>(messages.size()) > limit) {
    return fail(Errc::kTooLarge, "too many entries");
  }
  std::vector<T> out;
  for (const auto& message : messages) {
    Result<T> one = wire::from_message<T>(message);
    if (!one) {
      return tl::unexpected<Error>(one.error());
    }
    out.push_back(std::move(*one));
  }
  return out;
}

}  // namespace seeker::rpc
