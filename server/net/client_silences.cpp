#include "server/net/client_silences.hpp"

#include <algorithm>

namespace seeker::server_net {

void ClientSilences::add(const api::Caller& caller, Duration silence, bool stale) {
  const auto [entry, first] = now_.try_emplace(caller.client_name, Change{caller, stale, silence});
  if (!first) {
    entry->second.silent = entry->second.silent && stale;
    entry->second.silence = std::min(entry->second.silence, silence);
  }
}

std::vector<ClientSilences::Change> ClientSilences::changes() {
  std::vector<Change> changes;
  for (const auto& [name, change] : now_) {
    bool& was_silent = silent_[name];
    if (change.silent != was_silent) {
      was_silent = change.silent;
      changes.push_back(change);
    }
  }
  return changes;
}

}  // namespace seeker::server_net
