#include "server/app/fleet/fleet_slots.hpp"

#include "common/api/fleet.hpp"

namespace seeker::app {
namespace {

std::uint8_t lowest_free(const std::set<std::uint8_t>& taken) {
  std::uint8_t slot = kMainSlot + 1;
  while (taken.contains(slot)) {
    ++slot;
  }
  return slot;
}

}  // namespace

std::uint8_t FleetSlots::number_for(const std::string& robot_id, const std::set<std::uint8_t>& taken) const {
  if (const auto kept = kept_.find(robot_id); kept != kept_.end()) {
    return kept->second;
  }
  std::set<std::uint8_t> ever_taken = taken;
  for (const auto& [id, slot] : kept_) {
    ever_taken.insert(slot);
  }
  const std::uint8_t unused = lowest_free(ever_taken);
  return unused < api::kMaxFleetRobots ? unused : lowest_free(taken);
}

}  // namespace seeker::app
