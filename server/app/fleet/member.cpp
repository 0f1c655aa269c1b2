#include "server/app/fleet/member.hpp"

#include <utility>

namespace seeker::app {

bool silent(const std::optional<WallTime>& received, WallTime now, Duration limit) {
  return !received || now - *received >= limit;
}

Member::Member(MemberRecord record, std::uint8_t its_slot)
    : map(std::move(record.manifest), std::move(record.pieces)),
      standing(record.split, record.accepted),
      slot(its_slot) {
  report.topology = std::move(record.topology);
  if (report.topology) {
    report.topology->velocity.reset();
  }
  report.finds = std::move(record.finds);
}

/// All that was reported is in a map that is no more; reports in the new one come soon.
bool Member::begin_new_map(const api::FleetManifest& manifest) {
  report = {};
  if (map.manifest().nodes.empty() || manifest.nodes.empty()) {
    return false;  // its first map, or none yet
  }
  standing.begin_new_map();
  return true;
}

MemberRecord Member::record() const {
  return {map.manifest(), map.pieces(), standing.split(), standing.accepted(), report.topology, report.finds};
}

api::FleetMember Member::describe(WallTime now, Duration silence_limit) const {
  const api::FleetManifest& manifest = map.manifest();
  api::FleetMember out;
  out.robot_id = manifest.robot_id;
  standing.describe(out);
  out.linked = !silent(seen, now, 2 * silence_limit);
  out.nodes = static_cast<std::uint32_t>(manifest.nodes.size());
  out.pieces_missing = static_cast<std::uint32_t>(map.missing().size());
  out.pictures = static_cast<std::uint32_t>(manifest.pictures.size());
  if (out.main_T_map) {
    out.detections = report.finds_in(*out.main_T_map);
    if (manifest.map_T_base) {
      out.main_T_base = *out.main_T_map * *manifest.map_T_base;
    }
  }
  out.places.reserve(manifest.nodes.size());
  for (const api::FleetNode& node : manifest.nodes) {
    out.places.push_back(node.node.map_T_node.translation());
  }
  return out;
}

}  // namespace seeker::app
