#include "server/app/fleet/fleet_news.hpp"

#include <cstdio>
#include <utility>

namespace seeker::app {
namespace {

std::string text_of(const api::FleetFinding& finding) {
  const api::Detection& found = finding.detection;
  char place[96];
  if (found.position) {
    std::snprintf(place, sizeof place, " at (%.2f, %.2f) m", found.position->x(), found.position->y());
  } else {
    std::snprintf(place, sizeof place, " from (%.2f, %.2f) m, its place is not known yet", found.map_T_base.x_m,
                  found.map_T_base.y_m);
  }
  return "robot '" + finding.robot_id + "' has seen '" + found.target + "'" + place + " in this robot's map";
}

}  // namespace

void FleetNews::report(const std::vector<api::FleetFinding>& findings, const FleetHost& host) {
  std::map<Key, bool> reported;
  for (const api::FleetFinding& finding : findings) {
    const Key key{finding.robot_id, finding.detection.id};
    const auto before = reported_.find(key);
    const auto [known, is_first] = reported.try_emplace(key, before != reported_.end() && before->second);
    const bool is_new = is_first && before == reported_.end();
    const bool placed = finding.detection.position.has_value();
    if (is_new || (placed && !known->second)) {
      known->second = placed;
      host.notify_operator("fleet-found", text_of(finding), api::Severity::kInfo);
    }
  }
  reported_ = std::move(reported);
}

}  // namespace seeker::app
