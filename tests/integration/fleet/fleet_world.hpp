/// \file
/// Robots with toy maps, and a main robot over loopback.
#pragma once

#include <functional>
#include <mutex>
#include <thread>

#include <gtest/gtest.h>

#include "server/app/fleet_part.hpp"
#include "tests/support/process.hpp"
#include "tests/unit/server/fleet/toy_maps.hpp"

namespace seeker::testing {

using std::chrono::seconds;

inline const std::vector<Point2> kWest{{1.0, 6.0}, {14.0, 6.0}, {2.0, 6.2}};
inline const std::vector<Point2> kEast{{23.0, 6.0}, {8.0, 5.9}, {20.0, 6.0}};

inline LineMap west(std::uint64_t building = 1) {
  return fleet::toy_map(fleet::office(building), fleet::drive(kWest), 11);
}
inline LineMap east(std::uint64_t building = 1) {
  return fleet::toy_map(fleet::office(building), fleet::drive(kEast), 12);
}
/// Where the map `east` lies in the map `west`.
inline Pose2 west_T_east() { return inverse(fleet::drive(kWest).front()) * fleet::drive(kEast).front(); }

inline app::OwnMapSource holds(const LineMap& map) {
  return [map](const api::Reply<app::OwnMap>& reply) { reply(app::OwnMap{map, Pose2{1.0, 0.0, 0.0}}); };
}

/// Waits until a robot of the fleet is as wanted; its last description.
inline api::FleetMember until(const app::FleetLeader& leader, const std::string& robot_id,
                              const std::function<bool(const api::FleetMember&)>& wanted) {
  const auto end = std::chrono::steady_clock::now() + seconds(120);
  api::FleetMember last;
  while (std::chrono::steady_clock::now() < end) {
    for (const api::FleetMember& member : leader.status().members) {
      if (member.robot_id == robot_id) {
        last = member;
        if (wanted(member)) {
          return member;
        }
      }
    }
    std::this_thread::yield();
  }
  ADD_FAILURE() << robot_id << " is " << api::to_string(last.state) << ": " << last.reason;
  return last;
}

inline api::FleetMember until(const app::FleetLeader& leader, const std::string& robot_id, api::FleetState state) {
  return until(leader, robot_id, [state](const api::FleetMember& member) { return member.state == state; });
}

}  // namespace seeker::testing
