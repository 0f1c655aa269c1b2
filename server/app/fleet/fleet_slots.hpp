/// \file
/// The numbers of the robots in the joint map.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace seeker::app {

/// The main robot's own.
inline constexpr std::uint8_t kMainSlot = 0;

/// Numbers of robots by id. Ids of the joint map hold the number of the robot that a local map is from, so that a robot
/// keeps its number over restarts of the main robot. It has no lock: MemberBook guards it with its mutex.
class FleetSlots {
 public:
  FleetSlots() = default;
  explicit FleetSlots(std::map<std::string, std::uint8_t> kept) : kept_(std::move(kept)) {}

  /// The number that the robot had; else the lowest that no robot has had. Where all sixteen were given out, the lowest
  /// that is not in `taken`, the numbers of the other robots that are in the fleet now.
  [[nodiscard]] std::uint8_t number_for(const std::string& robot_id, const std::set<std::uint8_t>& taken) const;
  /// Keeps the number for the robot.
  void keep(const std::string& robot_id, std::uint8_t slot) { kept_[robot_id] = slot; }
  [[nodiscard]] const std::map<std::string, std::uint8_t>& kept() const { return kept_; }

 private:
  std::map<std::string, std::uint8_t> kept_;
};

}  // namespace seeker::app
