/// \file
/// Calls of which a client sends copies on further connections.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <utility>

#include "common/api/robot_api.hpp"
#include "seeker/v1/calls.pb.h"

namespace seeker::server_net {

/// Remembers the newest calls that carry a number `once`. A copy that the network held back must not stop a mission
/// that was started after the stop; the request itself is carried out even after a copy, since a start or a release
/// that the client sent before it may have come between. Used on the network thread; the robot replies on any.
class OnceCalls {
 public:
  using Work = std::function<void(api::Reply<void>)>;

  /// Whether it is a copy of what has come before, or the request itself after its copies. A request that comes again
  /// under the same number is another one.
  [[nodiscard]] bool known(const seeker::v1::Request& request) const;
  /// Does `work` and replies as it does. A copy of what has come before gets the reply of that.
  void carry_out(const seeker::v1::Request& request, const api::Reply<void>& reply, const Work& work);

 private:
  class Outcome;
  using Key = std::pair<int, std::uint64_t>;  ///< the call and its number

  struct Entry {
    Key key;
    bool requested = false;  ///< not only copies have come
    std::shared_ptr<Outcome> outcome;
  };

  /// Null: it has no number, or nothing with it came.
  [[nodiscard]] const Entry* find(const Key& key) const;

  std::deque<Entry> newest_;  ///< the newest first
};

}  // namespace seeker::server_net
