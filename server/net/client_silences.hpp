/// \file
/// ClientSilences finds out which clients have become silent and which have sent something again.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/api/robot_api.hpp"
#include "common/core/time.hpp"

namespace seeker::server_net {

/// Two sessions of one name are one client: it is silent while all of them are. It needs all open sessions in each
/// round: begin(), add() for each, changes().
class ClientSilences {
 public:
  struct Change {
    api::Caller caller;
    bool silent = false;
    Duration silence{};  ///< wall time
  };

  void begin() { now_.clear(); }
  /// One session of a client, which sent something `silence` ago; `stale`: that is more than it needs.
  void add(const api::Caller& caller, Duration silence, bool stale);
  /// What is different from the round before.
  [[nodiscard]] std::vector<Change> changes();
  /// The client has no session any more.
  void forget(const std::string& client) { silent_.erase(client); }

 private:
  std::map<std::string, Change> now_;
  std::map<std::string, bool> silent_;  ///< clients of the round before
};

}  // namespace seeker::server_net
