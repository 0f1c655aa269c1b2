#include "server/fleet/fleet_links.hpp"

#include <algorithm>
#include <optional>

namespace seeker::fleet {

std::map<std::uint8_t, FleetLink> links_from(std::uint8_t main, const std::vector<PairAnswer>& pairs) {
  std::map<std::uint8_t, FleetLink> links{{main, {main, 1.0}}};
  for (;;) {
    std::optional<std::uint8_t> next;
    FleetLink best;
    for (const PairAnswer& pair : pairs) {
      for (const auto& [from, to] : {std::pair(pair.slot_a, pair.slot_b), std::pair(pair.slot_b, pair.slot_a)}) {
        if (pair.answer.merged() && links.contains(from) && !links.contains(to)) {
          const double confidence = std::min(links.at(from).confidence, pair.answer.confidence());
          if (!next || confidence > best.confidence) {
            next = to;
            best = {from, confidence};
          }
        }
      }
    }
    if (!next) {
      links.erase(main);
      return links;
    }
    links.emplace(*next, best);
  }
}

}  // namespace seeker::fleet
