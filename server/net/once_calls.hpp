/// \file
/// Calls that a client sends on several connections at once and that are carried out one time.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <utility>

#include "common/api/robot_api.hpp"
#include "seeker/v1/calls.pb.h"

namespace seeker::server_net {

/// Remembers the newest calls that carry a number `once`: a copy that the network held back must not stop a mission
/// that was started after the stop. Used on the network thread; the robot replies on any.
class OnceCalls {
 public:
  using Work = std::function<void(api::Reply<void>)>;

  /// Whether a copy of the request has come before.
  [[nodiscard]] bool is_copy(const seeker::v1::Request& request) const;
  /// Does `work` unless a copy of the request has come before, and replies to each copy as `work` does.
  void carry_out(const seeker::v1::Request& request, const api::Reply<void>& reply, const Work& work);

 private:
  class Outcome;
  using Key = std::pair<int, std::uint64_t>;  ///< the call and its number

  [[nodiscard]] static Key key_of(const seeker::v1::Request& request);
  [[nodiscard]] std::shared_ptr<Outcome> find(const Key& key) const;

  std::deque<std::pair<Key, std::shared_ptr<Outcome>>> newest_;
};

}  // namespace seeker::server_net
