#include "server/lab/map_merging/fleet_exchange.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/angle.hpp"
#include "common/core/occupancy_tile.hpp"
#include "server/fleet/topology_map.hpp"
#include "server/nav/shared_floor.hpp"

namespace seeker::lab {
namespace {

constexpr Duration kSeenPeriod = std::chrono::seconds(5);
constexpr Duration kSharePeriod = std::chrono::seconds(1);

FleetDrawing drawing_of(const FleetMember& member, const Pose2& main_T_map) {
  return {member.id, main_T_map, member.loop->robot_map().segments(), member.loop->trajectory().poses(),
          member.loop->neighbours().own().topology};
}

RobotTopology seen_from(const Pose2& to_T_from, const FleetMember& from) {
  RobotTopology robot = fleet::moved(from.loop->neighbours().own(), to_T_from);
  robot.robot_id = from.id;
  const std::optional<api::MissionStatus>& mission = from.loop->missions().last();
  if (mission && mission->end) {
    // Its loop has ended, and with it its reports: the last one may be of a robot that drove.
    robot.velocity = Twist2{};
  }
  return robot;
}

}  // namespace

FleetExchange::FleetExchange(FleetMembers& members, const FleetSpec& spec, const fleet::MergeParams& merge)
    : members_(members),
      period_(seconds(spec.merge_period_s)),
      inject_false_pair_(spec.inject_false_pair),
      seen_(members.size()),
      merger_(merge) {
  for (std::size_t k = 0; spec.count_traffic && k < members_.size(); ++k) {
    traffic_.emplace_back(members_[k]->id);
  }
  for (std::size_t a = 0; a < members_.size(); ++a) {
    for (std::size_t b = a + 1; b < members_.size(); ++b) {
      relations_.push_back({a, b, {}, {}});
    }
  }
}

void FleetExchange::between(RobotTime now) {
  if (now >= next_merge_) {
    next_merge_ = now + period_;
    merge(now);
  }
  if (now >= next_seen_) {
    next_seen_ = now + kSeenPeriod;
    carry_seen();
  }
  for (std::size_t k = 0; k < members_.size(); ++k) {
    deliver(k);
  }
  if (now >= next_share_) {
    next_share_ = now + kSharePeriod;
    for (std::size_t k = 0; k < traffic_.size(); ++k) {
      traffic_[k].share(members_[k]->loop->neighbours().own());
    }
  }
}

void FleetExchange::fill(FleetResult& result) const {
  result.pairs = static_cast<int>(relations_.size());
  result.wrong = wrong_;
  result.injected = injected_;
  result.false_rejected = false_rejected_;
  result.false_offered = false_offered_;
  result.false_accepted = false_accepted_;
  for (const auto& member : members_) {
    result.pictures += static_cast<int>(member->loop->neighbours().own_pictures().size());
  }
  for (std::size_t k = 0; k < traffic_.size(); ++k) {
    const auto robots = static_cast<double>(traffic_.size());
    result.sent_bytes += static_cast<double>(traffic_[k].bytes()) / robots;
    result.seen_m2 += free_area_m2(members_[k]->loop->robot_map().occupancy().snapshot()) / robots;
  }
  result.drawings.push_back(drawing_of(*members_.front(), Pose2{}));
  for (const Relation& relation : relations_) {
    if (relation.a_T_b && relation.a == 0) {
      result.drawings.push_back(drawing_of(*members_[relation.b], *relation.a_T_b));
    }
    if (relation.a_T_b) {
      const auto [error_m, error_rad] = error_of(relation);
      const auto alike = static_cast<int>(relation.alike);
      result.alike = result.merged == 0 ? alike : std::min(result.alike, alike);
      ++result.merged;
      result.merged_at_s = std::max(result.merged_at_s, to_seconds(*relation.since));
      result.error_m = std::max(result.error_m, error_m);
      result.error_deg = std::max(result.error_deg, rad_to_deg(error_rad));
    }
  }
}

fleet::NodePictures FleetExchange::pictures_of(std::size_t member) const {
  fleet::NodePictures pictures = members_[member]->loop->neighbours().own_pictures();
  const fleet::NodePictures& first = members_.front()->loop->neighbours().own_pictures();
  if (inject_false_pair_ && member == 1 && !pictures.empty() && !first.empty()) {
    fleet::NodePicture copied = *pictures.front();
    copied.features = first.front()->features;
    pictures.push_back(std::make_shared<const fleet::NodePicture>(std::move(copied)));
  }
  return pictures;
}

void FleetExchange::take_maps() {
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const auto& member = members_[k];
    if (Result<LineMap> map = member->loop->robot_map().map()) {
      fleet::NodePictures pictures = pictures_of(k);
      if (!traffic_.empty()) {
        traffic_[k].announce(*map, pictures);
      }
      member->map.set_pictures(std::move(pictures));
      (void)member->map.update(*std::move(map));  // a map without walls yet is not to be merged
    }
  }
}

void FleetExchange::merge(RobotTime now) {
  take_maps();
  for (Relation& relation : relations_) {
    const fleet::MergeAnswer answer = merger_.merge(members_[relation.a]->map, members_[relation.b]->map);
    count_false_pair(answer, relation);
    if (answer.merged()) {
      relation.a_T_b = answer.hypotheses.front().a_T_b.a_T_b;
      relation.since = relation.since.value_or(now);
      relation.alike = answer.hypotheses.front().pictures.alike;
      const auto [error_m, error_rad] = error_of(relation);
      wrong_ += error_m > kWrongMerge_m || error_rad > kWrongMerge_rad ? 1 : 0;
    }
  }
}

/// The false pair is of the first picture of the first robot and the last one of the second.
void FleetExchange::count_false_pair(const fleet::MergeAnswer& answer, const Relation& relation) {
  const fleet::PreparedMap& a = members_[relation.a]->map;
  const fleet::PreparedMap& b = members_[relation.b]->map;
  if (!inject_false_pair_ || relation.a != 0 || relation.b != 1 || a.pictures().empty() || b.pictures().empty()) {
    return;
  }
  ++injected_;
  const std::uint32_t node_a = a.pictures().front()->node;
  const std::uint32_t node_b = b.pictures().back()->node;
  false_rejected_ += std::any_of(answer.rejected.begin(), answer.rejected.end(),
                                 [&](const fleet::RejectedPair& pair) {
                                   return pair.by_pictures && pair.node_a == node_a && pair.node_b == node_b;
                                 })
                         ? 1
                         : 0;
  // Put at the start of the first robot, the second one is where the false pair says.
  const Pose2 false_a_T_b;
  const auto says_false = [&](const fleet::MergeHypothesis& one) {
    return distance_m(one.a_T_b.a_T_b, false_a_T_b) < kWrongMerge_m;
  };
  false_offered_ += std::any_of(answer.hypotheses.begin(), answer.hypotheses.end(), says_false) ? 1 : 0;
  false_accepted_ += answer.merged() && says_false(answer.hypotheses.front()) ? 1 : 0;
}

std::pair<double, double> FleetExchange::error_of(const Relation& relation) const {
  const Pose2 world_T_a = members_[relation.a]->simulation->truth().world_T_start;
  const Pose2 world_T_b = members_[relation.b]->simulation->truth().world_T_start;
  const Pose2 truth = inverse(world_T_a) * world_T_b;
  return {distance_m(truth, *relation.a_T_b), std::abs(wrap_angle(truth.theta_rad - relation.a_T_b->theta_rad))};
}

std::vector<FleetExchange::Partner> FleetExchange::partners_of(std::size_t to) const {
  std::vector<Partner> partners;
  for (const Relation& relation : relations_) {
    if (relation.a_T_b && (relation.a == to || relation.b == to)) {
      const Pose2 to_T_from = relation.a == to ? *relation.a_T_b : inverse(*relation.a_T_b);
      partners.push_back({to_T_from, members_[relation.a == to ? relation.b : relation.a].get()});
    }
  }
  return partners;
}

void FleetExchange::deliver(std::size_t to) {
  FleetView view{.robot_id = members_[to]->id, .others = {}, .floor = seen_[to].floor, .sides = seen_[to].sides};
  for (const Partner& partner : partners_of(to)) {
    view.others.push_back(seen_from(partner.to_T_from, *partner.from));
  }
  members_[to]->loop->neighbours().set_fleet(std::move(view), members_[to]->loop->now());
}

/// To each robot the floor and the walls that the others which are merged with it have seen.
void FleetExchange::carry_seen() {
  for (std::size_t to = 0; to < members_.size(); ++to) {
    std::vector<std::pair<Pose2, nav::SharedFloor>> floors;
    std::vector<MappedSide> sides;
    for (const Partner& partner : partners_of(to)) {
      if (auto seen = partner.from->loop->robot_map().occupancy().snapshot()) {
        floors.emplace_back(partner.to_T_from, std::make_shared<const Grid<std::uint8_t>>(*std::move(seen)));
      }
      const std::vector<MappedSide> theirs =
          moved(sides_of(partner.from->loop->robot_map().segments()), partner.to_T_from);
      sides.insert(sides.end(), theirs.begin(), theirs.end());
    }
    seen_[to] = {nav::carried(floors), std::make_shared<const std::vector<MappedSide>>(std::move(sides))};
    if (!traffic_.empty()) {
      const app::RobotMap& map = members_[to]->loop->robot_map();
      const Point2 here_map = members_[to]->loop->status().pose.map_T_base.translation();
      traffic_[to].seen(api::within_limits(map.tiles_since(0).tiles, here_map),
                        api::within_limits(sides_of(map.segments()), here_map));
    }
  }
}

}  // namespace seeker::lab
