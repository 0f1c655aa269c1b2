/// \file
/// A robot as the main one hears of it, without a network between them.
#pragma once

#include <gtest/gtest.h>

#include "server/app/fleet/fleet_leader.hpp"

namespace seeker::testing {

inline app::PackedMap packed(const LineMap& map, const std::string& robot_id = "r1", std::uint64_t instance = 1) {
  Result<app::PackedMap> made = app::pack_map(map, robot_id);
  EXPECT_TRUE(made);
  made->manifest.instance = instance;
  return std::move(*made);
}

/// Announces and sends everything that is missing.
inline void join(app::FleetLeader& leader, const app::PackedMap& robot) {
  const auto answer = leader.announce(robot.manifest);
  ASSERT_TRUE(answer) << answer.error().message;
  for (const api::FleetMissing& missing : answer->missing) {
    const std::vector<std::uint8_t>& bytes = *robot.pieces.at(missing.hash);
    const auto from = bytes.begin() + static_cast<std::ptrdiff_t>(missing.offset);
    const auto received = leader.receive({robot.manifest.robot_id, missing.hash, missing.offset, {from, bytes.end()}});
    ASSERT_TRUE(received) << received.error().message;
    EXPECT_EQ(*received, bytes.size());
  }
}

}  // namespace seeker::testing
