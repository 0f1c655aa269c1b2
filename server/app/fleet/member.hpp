/// \file
/// One robot that has joined the main robot.
#pragma once

#include <cstdint>
#include <optional>

#include "common/api/fleet.hpp"
#include "server/app/fleet/announced_map.hpp"
#include "server/app/fleet/member_record.hpp"
#include "server/app/fleet/member_standing.hpp"
#include "server/app/fleet/robot_report.hpp"

namespace seeker::app {

/// Whether a robot whose last message came at a time, or never, counts as gone.
[[nodiscard]] bool silent(const std::optional<WallTime>& received, WallTime now, Duration limit);

/// An entry of the book of members. It has no lock: MemberBook guards it with its mutex.
struct Member {
  Member() = default;
  /// As it was before the main robot was restarted.
  Member(MemberRecord record, std::uint8_t its_slot);

  /// The robot announces another map than before, none of whose local maps is where it was. The answer is whether it
  /// had a map before and has one now.
  [[nodiscard]] bool begin_new_map(const api::FleetManifest& manifest);
  [[nodiscard]] MemberRecord record() const;
  /// Its entry in the status of the fleet.
  [[nodiscard]] api::FleetMember describe(WallTime now, Duration silence_limit) const;

  AnnouncedMap map;
  RobotReport report;
  MemberStanding standing;
  std::uint8_t slot = 1;           ///< its number in the joint map
  std::optional<WallTime> seen;    ///< when it last called
  std::optional<WallTime> shared;  ///< when it last reported its topology
  std::optional<WallTime> judged;
  bool judgement_waits = false;  ///< the worker was asked to judge its map
  bool record_waits = false;     ///< the worker was asked to write its record
};

}  // namespace seeker::app
