/// \file
/// What the main robot of a fleet passes on from each robot to the others.
#pragma once

#include <optional>
#include <vector>

#include "common/api/fleet.hpp"
#include "server/app/fleet/fleet_news.hpp"
#include "server/app/fleet/inbox.hpp"
#include "server/app/fleet/member_book.hpp"
#include "server/app/fleet/own_map.hpp"
#include "server/app/fleet/own_robot.hpp"

namespace seeker::app {

struct FleetSharingParams {
  Duration floor_period = std::chrono::seconds(5);  ///< wall time between what its own robot receives of others' floor
  Duration search_age = std::chrono::hours(1);      ///< see FleetSettings
};

/// Topologies, floor, walls, finds and searched floor of all robots that are merged, carried into the frame of the
/// robot that receives them. Any thread may call share(), seen() and scene(): they hold no state of this, the book and
/// the main robot lock themselves. One thread at a time may call refresh(), whose state is guarded by no mutex.
class FleetSharing {
 public:
  /// `book` and `main` must outlive this.
  FleetSharing(const FleetSharingParams& params, MemberBook& book, OwnRobot& main, FleetHost host);

  /// The topology of a robot for those of the others. kNotFound: it has to announce its map first.
  [[nodiscard]] Result<api::FleetShared> share(const api::FleetShare& share);
  /// What a robot has seen for what the others have. kNotFound: as above.
  [[nodiscard]] Result<api::FleetSightings> seen(const api::FleetSeen& seen);
  /// What the main robot and all that are merged with it have reported, in the frame `map` of the main robot.
  /// kNotReady: none of them has reported floor or a pose yet.
  [[nodiscard]] Result<api::FleetScene> scene() const;
  /// The exchange for the main robot itself: asks its loop for both, and gives it its view of the fleet. The answer is
  /// whether it has found other targets than before.
  [[nodiscard]] bool refresh();

 private:
  [[nodiscard]] std::vector<OtherRobot> others_of(ReportingRobot received) const;
  [[nodiscard]] std::vector<OtherRobot> others_of_main(WallTime now) const;
  [[nodiscard]] bool refresh_seen(WallTime now);

  const FleetSharingParams params_;
  MemberBook& book_;
  OwnRobot& main_;
  const FleetHost host_;
  // For refresh() only.
  Inbox<OwnTopology> topology_inbox_;
  Inbox<OwnSeen> seen_inbox_;
  WallTime floor_at_;              ///< when what was seen is exchanged next
  nav::SharedFloor others_floor_;  ///< what the main robot received last
  SharedSearch others_searched_;   ///< what the main robot received last
  SharedSides others_sides_;       ///< what the main robot received last
  FleetNews news_;
};

}  // namespace seeker::app
