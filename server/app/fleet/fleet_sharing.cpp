#include "server/app/fleet/fleet_sharing.hpp"

#include <iterator>
#include <utility>

namespace seeker::app {

FleetSharing::FleetSharing(const FleetSharingParams& params, MemberBook& book, OwnRobot& main, FleetHost host)
    : params_(params), book_(book), main_(main), host_(std::move(host)) {}

/// The main robot first: of cells of the floor that more than one knows the first counts.
std::vector<OtherRobot> FleetSharing::others_of(ReportingRobot received) const {
  std::vector<OtherRobot> others;
  if (received.main_T_map) {
    others.reserve(received.others.size() + 1);
    others.push_back({main_.id(), main_.report(), inverse(*received.main_T_map), false});
    others.insert(others.end(), std::make_move_iterator(received.others.begin()),
                  std::make_move_iterator(received.others.end()));
  }
  return others;
}

/// None while the main robot has not taken up its map: its frame is another one until then. The book is asked first,
/// since it has merged robots of a remembered map only after the main robot was marked as remembered.
std::vector<OtherRobot> FleetSharing::others_of_main(WallTime now) const {
  std::vector<OtherRobot> others = book_.merged(now);
  if (main_.remembered()) {
    others.clear();
  }
  return others;
}

Result<api::FleetShared> FleetSharing::share(const api::FleetShare& share) {
  Result<ReportingRobot> received = book_.receive(share, std::chrono::steady_clock::now());
  if (!received) {
    return tl::unexpected<Error>(received.error());
  }
  const api::FleetState state = received->state;
  return api::FleetShared{state, topologies_of(others_of(std::move(*received)))};
}

Result<api::FleetSightings> FleetSharing::seen(const api::FleetSeen& seen) {
  const WallTime now = std::chrono::steady_clock::now();
  Result<ReportingRobot> received = book_.receive(seen, now);
  if (!received) {
    return tl::unexpected<Error>(received.error());
  }
  const Point2 p_map = received->map_T_base.value_or(Pose2{}).translation();
  const std::vector<OtherRobot> others = others_of(std::move(*received));
  const nav::SharedFloor floor = nav::carried(floors_of(others));
  return api::FleetSightings{floor ? api::within_limits(cut(*floor), p_map) : std::vector<OccupancyTile>(),
                             findings_of(others), searched_by(others, now, params_.search_age), sides_by(others)};
}

Result<api::FleetScene> FleetSharing::scene() const {
  std::vector<OtherRobot> robots;
  robots.push_back({main_.id(), main_.report(), Pose2{}, false});
  std::vector<OtherRobot> merged = others_of_main(std::chrono::steady_clock::now());
  robots.insert(robots.end(), std::make_move_iterator(merged.begin()), std::make_move_iterator(merged.end()));

  api::FleetScene scene;
  scene.robots = topologies_of(robots);
  const Point2 p_map = scene.robots.empty() ? Point2::Zero() : scene.robots.front().map_T_base.translation();
  if (const nav::SharedFloor floor = nav::carried(floors_of(robots))) {
    scene.floor = api::within_limits(cut(*floor), p_map);
  }
  scene.findings = findings_of(robots);
  if (scene.robots.empty() && scene.floor.empty()) {
    return fail(Errc::kNotReady, "no robot of the fleet has reported floor or its pose yet; try again in some seconds");
  }
  return scene;
}

/// Floors of buildings are large: they are exchanged less often than topologies.
bool FleetSharing::refresh_seen(WallTime now) {
  const std::optional<OwnSeen> own = seen_inbox_.take();
  const bool found_more = own && main_.receive(*own, now);
  const std::vector<OtherRobot> others = others_of_main(now);
  others_floor_ = nav::carried(floors_of(others));
  others_searched_ = shared_list(searched_by(others, now, params_.search_age), others_searched_);
  others_sides_ = shared_list(sides_by(others), others_sides_);
  news_.report(findings_of(others), host_);
  host_.give_seen(seen_inbox_.reply());
  return found_more;
}

bool FleetSharing::refresh() {
  const WallTime now = std::chrono::steady_clock::now();
  bool found_more = false;
  if (now >= floor_at_) {
    floor_at_ = now + params_.floor_period;
    found_more = refresh_seen(now);
  }
  host_.give_topology(topology_inbox_.reply());
  if (const std::optional<OwnTopology> own = topology_inbox_.take()) {
    main_.receive(*own);
  }
  std::vector<RobotTopology> others = topologies_of(others_of_main(now));
  host_.take_view(others.empty() ? std::nullopt
                                 : std::optional(FleetView{main_.id(), std::move(others), others_floor_,
                                                           others_searched_, others_sides_}));
  return found_more;
}

}  // namespace seeker::app
