#include "server/lab/map_merging/fleet_traffic.hpp"

#include "common/wire/convert_fleet.hpp"
#include "server/app/fleet/fleet_pieces.hpp"

namespace seeker::lab {
namespace {

template <class M, class T>
std::uint64_t size_of(const T& value) {
  M message;
  wire::write(value, &message);
  return message.ByteSizeLong();
}

}  // namespace

void FleetTraffic::announce(const LineMap& map, const fleet::NodePictures& pictures) {
  const Result<app::PackedMap> packed = app::pack_map(map, robot_id_, pictures);
  if (!packed) {
    return;
  }
  bytes_ += size_of<v1::FleetManifest>(packed->manifest);
  for (const auto& [hash, bytes] : packed->pieces) {
    bytes_ += sent_.insert(hash).second ? bytes->size() : 0;
  }
}

void FleetTraffic::share(const RobotTopology& topology) {
  bytes_ += size_of<v1::FleetShare>(api::FleetShare{robot_id_, 1, api::within_limits(topology)});
}

void FleetTraffic::seen(const std::vector<OccupancyTile>& tiles, const std::vector<MappedSide>& sides) {
  bytes_ += size_of<v1::FleetSeen>(api::FleetSeen{robot_id_, 1, true, tiles, {}, {}, sides});
}

}  // namespace seeker::lab
