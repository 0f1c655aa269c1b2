#include "server/app/fleet_news.hpp"

#include <cstdio>

namespace seeker::app {
namespace {

constexpr std::size_t kMaxTold = 4096;  // a main robot that makes findings up does not fill the memory

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

void FleetNews::tell(const std::vector<api::FleetFinding>& findings, const FleetHost& host) {
  for (const api::FleetFinding& finding : findings) {
    if (told_.size() >= kMaxTold) {
      return;
    }
    const bool placed = finding.detection.position.has_value();
    const auto [known, is_new] = told_.try_emplace({finding.robot_id, finding.detection.id}, placed);
    if (is_new || (placed && !known->second)) {
      known->second = placed;
      host.tell_operator("fleet-found", text_of(finding), api::Severity::kInfo);
    }
  }
}

}  // namespace seeker::app
