#include <algorithm>
#include <memory>
#include <utility>

#include "common/wire/convert.hpp"
#include "common/wire/convert_fleet.hpp"
#include "common/wire/fleet_fields.hpp"

namespace seeker::wire {
namespace {

constexpr int kSideNumbers = 4;

using TileField = google::protobuf::RepeatedPtrField<pb::Tile>;

void write_tiles(const std::vector<OccupancyTile>& from, TileField* to) {
  for (const OccupancyTile& tile : from) {
    write(tile, to->Add());
  }
}

/// A few tiles far apart would make a grid larger than all memory.
bool close_together(const std::vector<OccupancyTile>& tiles) {
  const auto spread = [&](auto coordinate) {
    const auto [low, high] = std::minmax_element(
        tiles.begin(), tiles.end(), [&](const auto& a, const auto& b) { return coordinate(a) < coordinate(b); });
    return coordinate(*high) - coordinate(*low);
  };
  return tiles.empty() ||
         (spread([](const OccupancyTile& tile) { return tile.index.i; }) < api::kMaxFleetFloorSide_tiles &&
          spread([](const OccupancyTile& tile) { return tile.index.j; }) < api::kMaxFleetFloorSide_tiles);
}

void read_tiles(const TileField& from, std::vector<OccupancyTile>& to, Check& check) {
  if (!check.count("tiles", static_cast<std::size_t>(from.size()), api::kMaxFleetTiles)) {
    return;
  }
  for (int k = 0; k < from.size() && check.ok(); ++k) {
    const auto scope = check.in("tiles", static_cast<std::size_t>(k));
    read(from[k], to.emplace_back(), check);
  }
  if (!close_together(to)) {
    check.refuse("tiles", Errc::kTooLarge, "are too far apart");
  }
}

using NumberField = google::protobuf::RepeatedField<float>;

void write_sides(const std::vector<MappedSide>& from, NumberField* to) {
  for (const MappedSide& side : from) {
    for (const double number : {side.left_map.x(), side.left_map.y(), side.right_map.x(), side.right_map.y()}) {
      to->Add(static_cast<float>(number));
    }
  }
}

/// The sides that up to so many robots have mapped.
void read_sides(const NumberField& from, std::vector<MappedSide>& to, std::size_t robots, Check& check) {
  if (from.size() % kSideNumbers != 0) {
    check.refuse("sides", Errc::kInvalidArgument, "must have four numbers each");
    return;
  }
  if (!check.count("sides", static_cast<std::size_t>(from.size() / kSideNumbers), robots * api::kMaxFleetSides)) {
    return;
  }
  const auto number = [&](int k) { return within(from[k], api::kMaxFleetReach_m, "sides", check); };
  for (int k = 0; k < from.size() && check.ok(); k += kSideNumbers) {
    to.push_back({{number(k), number(k + 1)}, {number(k + 2), number(k + 3)}});
  }
}

void write_findings(const std::vector<api::FleetFinding>& from, pb::FleetReply* to) {
  for (const api::FleetFinding& finding : from) {
    pb::FleetFinding* one = to->add_findings();
    one->set_robot_id(finding.robot_id);
    write(finding.detection, one->mutable_detection());
  }
}

void read_findings(const pb::FleetReply& from, std::vector<api::FleetFinding>& to, std::size_t most_robots,
                   Check& check) {
  if (!check.count("findings", static_cast<std::size_t>(from.findings_size()),
                   api::kMaxFleetDetections * most_robots)) {
    return;
  }
  for (int k = 0; k < from.findings_size(); ++k) {
    const auto scope = check.in("findings", static_cast<std::size_t>(k));
    api::FleetFinding& finding = to.emplace_back();
    finding.robot_id = read_robot_id(from.findings(k).robot_id(), check);
    read_required(from.findings(k).has_detection(), from.findings(k).detection(), finding.detection, "detection",
                  check);
    check_reach(finding.detection, check);
  }
}

}  // namespace

void write(const SearchedFloor& from, pb::SearchedFloor* to) {
  for (const std::string& target : from.targets) {
    to->add_targets(clean_text(target, kMaxNameBytes));
  }
  write(from.map_T_grid, to->mutable_map_t_grid());
  if (from.probability) {
    write(*from.probability, to->mutable_probability());
  }
}

void read(const pb::SearchedFloor& from, SearchedFloor& to, Check& check) {
  const auto too_long = [](std::uint32_t cells) { return cells > api::kMaxFleetSearchedSide_cells; };
  if (!check.count("targets", static_cast<std::size_t>(from.targets_size()), api::kMaxFleetTargets)) {
    return;
  }
  if (too_long(from.probability().width()) || too_long(from.probability().height())) {
    check.refuse("probability", Errc::kTooLarge, "is more than 512 cells wide or high");
    return;
  }
  for (const std::string& target : from.targets()) {
    to.targets.push_back(check.text("targets", target, kMaxNameBytes));
  }
  to.map_T_grid = read_place_pose(from.has_map_t_grid(), from.map_t_grid(), "map_t_grid", check);
  Grid<std::uint8_t> probability;
  read_required(from.has_probability(), from.probability(), probability, "probability", check);
  const auto scope = check.in("probability");
  const Point2& origin = probability.frame().origin;
  within(origin.x(), api::kMaxFleetReach_m, "origin_x_m", check);
  within(origin.y(), api::kMaxFleetReach_m, "origin_y_m", check);
  within(probability.frame().resolution_m, kMaxSearchedCell_m, "resolution_m", check);
  to.probability = std::make_shared<const Grid<std::uint8_t>>(std::move(probability));
}

void write(const api::FleetSeen& from, pb::FleetSeen* to) {
  to->set_robot_id(from.robot_id);
  to->set_instance(from.instance);
  to->set_placed(from.placed);
  write_tiles(from.tiles, to->mutable_tiles());
  write_detections(from.detections, to->mutable_detections());
  if (from.searched) {
    write(*from.searched, to->mutable_searched());
  }
  write_sides(from.sides, to->mutable_sides());
}

void read(const pb::FleetSeen& from, api::FleetSeen& to, Check& check) {
  to.robot_id = read_robot_id(from.robot_id(), check);
  to.instance = from.instance();
  to.placed = from.placed();
  read_tiles(from.tiles(), to.tiles, check);
  read_detections(from.detections(), to.detections, check);
  if (from.has_searched()) {
    const auto scope = check.in("searched");
    read(from.searched(), to.searched.emplace(), check);
  }
  read_sides(from.sides(), to.sides, 1, check);
}

void write(const api::FleetSightings& from, pb::FleetReply* to) {
  write_tiles(from.floor, to->mutable_floor());
  write_findings(from.findings, to);
  for (const SearchedFloor& searched : from.searched) {
    write(searched, to->add_searched());
  }
  write_sides(from.sides, to->mutable_sides());
}

void read(const pb::FleetReply& from, api::FleetSightings& to, Check& check) {
  read_tiles(from.floor(), to.floor, check);
  read_findings(from, to.findings, api::kMaxFleetRobots - 1, check);
  read_sides(from.sides(), to.sides, api::kMaxFleetRobots - 1, check);
  if (!check.count("searched", static_cast<std::size_t>(from.searched_size()), api::kMaxFleetRobots - 1)) {
    return;
  }
  for (int k = 0; k < from.searched_size(); ++k) {
    const auto scope = check.in("searched", static_cast<std::size_t>(k));
    read(from.searched(k), to.searched.emplace_back(), check);
  }
}

void write(const api::FleetScene& from, pb::FleetReply* to) {
  write_tiles(from.floor, to->mutable_floor());
  write_others(from.robots, to);
  write_findings(from.findings, to);
}

void read(const pb::FleetReply& from, api::FleetScene& to, Check& check) {
  read_tiles(from.floor(), to.floor, check);
  read_others(from, to.robots, api::kMaxFleetRobots, check);
  read_findings(from, to.findings, api::kMaxFleetRobots, check);
}

}  // namespace seeker::wire
