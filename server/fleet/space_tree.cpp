#include "server/fleet/space_tree.hpp"

#include <algorithm>
#include <cmath>

namespace seeker::fleet {
namespace {

/// Chords shorter than this part of W are noise (spec S4.1).
constexpr double kLeastChord = 0.25;

/// An arc [from, to] of unwrapped angles, from <= to.
struct Arc {
  double from_rad = 0.0;
  double to_rad = 0.0;
};

/// A return in polar coordinates about the laser, its angle in the laser's frame.
struct Hit {
  double range_m = 0.0;
  double angle_rad = 0.0;
};

std::vector<Hit> hits_of(const LaserScan& scan, double max_range_m) {
  std::vector<Hit> hits;
  hits.reserve(scan.ranges_m.size());
  for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
    const auto range_m = static_cast<double>(scan.ranges_m[beam]);
    if (std::isfinite(range_m) && range_m >= scan.range_min_m && range_m > 0.0 && range_m <= max_range_m) {
      hits.push_back({range_m, scan.angle_rad(beam)});
    }
  }
  return hits;
}

/// The field of view of the scanner. A full circle is cut where the nearest hit blocks every layer, so that no section
/// is cut in two.
Arc field_of_view(const LaserScan& scan, const std::vector<Hit>& hits) {
  const double step_rad = std::abs(scan.angle_step_rad);
  const double last_rad = scan.angle_rad(scan.ranges_m.size() - 1);
  const double span_rad = std::abs(last_rad - scan.angle_min_rad);
  if (span_rad + step_rad < kTwoPi - 0.5 * step_rad) {
    return {std::min(scan.angle_min_rad, last_rad), std::max(scan.angle_min_rad, last_rad)};
  }
  const auto nearest =
      std::min_element(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.range_m < b.range_m; });
  const double cut_rad = nearest == hits.end() ? -kPi : nearest->angle_rad;
  return {cut_rad, cut_rad + kTwoPi};
}

/// The directions that one hit blocks at a radius, relative to its own: nothing, one arc, or a sliver at either side
/// where only a corner of the rectangle reaches the hit.
void add_blocked(const Hit& hit, double radius_m, double half_width_m, std::vector<Arc>& blocked) {
  const double outer_rad = hit.range_m > half_width_m ? std::asin(half_width_m / hit.range_m) : 0.5 * kPi;
  if (hit.range_m <= radius_m) {
    blocked.push_back({hit.angle_rad - outer_rad, hit.angle_rad + outer_rad});
    return;
  }
  const double inner_rad = std::acos(radius_m / hit.range_m);
  if (inner_rad < outer_rad) {
    blocked.push_back({hit.angle_rad - outer_rad, hit.angle_rad - inner_rad});
    blocked.push_back({hit.angle_rad + inner_rad, hit.angle_rad + outer_rad});
  }
}

/// The parts of `view` that no arc blocks; arcs count at every full circle.
std::vector<Arc> free_arcs(const Arc& view, const std::vector<Arc>& blocked) {
  std::vector<Arc> inside;
  inside.reserve(blocked.size());
  for (const Arc& arc : blocked) {
    const double first = arc.from_rad + kTwoPi * std::ceil((view.from_rad - arc.to_rad) / kTwoPi);
    const double width = arc.to_rad - arc.from_rad;
    for (double from = first; from <= view.to_rad; from += kTwoPi) {
      inside.push_back({from, from + width});
    }
  }
  std::sort(inside.begin(), inside.end(), [](const Arc& a, const Arc& b) { return a.from_rad < b.from_rad; });
  std::vector<Arc> free;
  double at_rad = view.from_rad;
  for (const Arc& arc : inside) {
    if (arc.from_rad > at_rad) {
      free.push_back({at_rad, arc.from_rad});
    }
    at_rad = std::max(at_rad, arc.to_rad);
  }
  if (at_rad < view.to_rad) {
    free.push_back({at_rad, view.to_rad});
  }
  return free;
}

bool wide_enough(const Arc& arc, double radius_m, double width_m) {
  const double half_rad = 0.5 * (arc.to_rad - arc.from_rad);
  return half_rad >= 0.5 * kPi || 2.0 * radius_m * std::sin(half_rad) >= kLeastChord * width_m;
}

/// The section of the layer below that holds the middle of a new one.
std::optional<std::size_t> parent_of(const std::vector<SpaceSection>& sections, std::size_t below_from,
                                     std::size_t below_to, const SpaceSection& section) {
  const double middle_rad = section.start_rad + 0.5 * section.span_rad;
  for (std::size_t k = below_from; k < below_to; ++k) {
    const double into_rad = wrap_angle(middle_rad - sections[k].start_rad - 0.5 * sections[k].span_rad);
    if (std::abs(into_rad) <= 0.5 * sections[k].span_rad) {
      return k;
    }
  }
  return std::nullopt;
}

void add_goals(SpaceTree& tree, std::size_t index, const SpaceTreeParams& params) {
  const SpaceSection& section = tree.sections[index];
  if (!section.leaf || section.layer == 0 || section.radius_m < params.min_goal_radius_m) {
    return;
  }
  const int goals = std::max(1, static_cast<int>(std::ceil(section.span_rad / params.max_goal_span_rad)));
  const double reach_m = section.radius_m - params.corridor_width_m;
  for (int k = 0; k < goals; ++k) {
    const double angle_rad = section.start_rad + section.span_rad * (k + 0.5) / goals;
    const Point2 p_base = tree.base_T_laser.translation() + reach_m * Point2(std::cos(angle_rad), std::sin(angle_rad));
    tree.goals.push_back({p_base, section.layer, index});
  }
}

void add_layer(SpaceTree& tree, int layer, double radius_m, const std::vector<Arc>& free, double width_m,
               std::size_t below_from) {
  const std::size_t below_to = tree.sections.size();
  for (const Arc& arc : free) {
    if (!wide_enough(arc, radius_m, width_m)) {
      continue;
    }
    SpaceSection section;
    section.layer = layer;
    section.radius_m = radius_m;
    section.start_rad = wrap_angle(arc.from_rad + tree.base_T_laser.theta_rad);
    section.span_rad = arc.to_rad - arc.from_rad;
    section.parent = parent_of(tree.sections, below_from, below_to, section);
    if (section.parent) {
      tree.sections[*section.parent].leaf = false;
      tree.sections.push_back(section);
    }
  }
}

/// Up to the nearest hit every direction is free; the rectangle's corners are what meets it first.
void add_root(SpaceTree& tree, const Arc& view, double min_range_m, double width_m) {
  SpaceSection root;
  root.radius_m = std::sqrt(std::max(0.0, min_range_m * min_range_m - 0.25 * width_m * width_m));
  root.start_rad = wrap_angle(view.from_rad + tree.base_T_laser.theta_rad);
  root.span_rad = view.to_rad - view.from_rad;
  tree.sections.push_back(root);
}

}  // namespace

bool SpaceTree::admits(const Point2& p_base) const {
  const Point2 d = p_base - base_T_laser.translation();
  const double range_m = d.norm();
  const double angle_rad = std::atan2(d.y(), d.x());
  return std::any_of(sections.begin(), sections.end(), [&](const SpaceSection& section) {
    const double into_rad = wrap_angle(angle_rad - section.start_rad - 0.5 * section.span_rad);
    return section.radius_m >= range_m && std::abs(into_rad) <= 0.5 * section.span_rad;
  });
}

SpaceTree build_space_tree(const LaserScan& scan, const SpaceTreeParams& params) {
  SpaceTree tree;
  tree.base_T_laser = scan.base_T_laser;
  if (scan.ranges_m.empty()) {
    return tree;
  }
  const double max_range_m = std::min(params.max_range_m, scan.range_max_m);
  const std::vector<Hit> hits = hits_of(scan, max_range_m);
  double min_range_m = hits.empty() ? 0.0 : max_range_m;
  for (const Hit& hit : hits) {
    min_range_m = std::min(min_range_m, hit.range_m);
  }
  const Arc view = field_of_view(scan, hits);
  add_root(tree, view, min_range_m, params.corridor_width_m);
  std::vector<Arc> blocked;
  std::size_t below_from = 0;
  for (int layer = 1; layer <= params.layers; ++layer) {
    const double radius_m = min_range_m + layer * (max_range_m - min_range_m) / params.layers;
    blocked.clear();
    for (const Hit& hit : hits) {
      add_blocked(hit, radius_m, 0.5 * params.corridor_width_m, blocked);
    }
    const std::size_t first = tree.sections.size();
    add_layer(tree, layer, radius_m, free_arcs(view, blocked), params.corridor_width_m, below_from);
    below_from = first;
  }
  for (std::size_t k = 0; k < tree.sections.size(); ++k) {
    add_goals(tree, k, params);
  }
  std::vector<GoalDirection> directions;
  directions.reserve(tree.goals.size());
  for (const SpaceGoal& goal : tree.goals) {
    directions.push_back({goal.layer, std::atan2(goal.p_base.y(), goal.p_base.x())});
  }
  tree.main_goal = main_goal_of(directions, 0.0);
  return tree;
}

std::optional<std::size_t> main_goal_of(const std::vector<GoalDirection>& goals, double heading_rad) {
  const auto best =
      std::min_element(goals.begin(), goals.end(), [heading_rad](const GoalDirection& a, const GoalDirection& b) {
        if (a.layer != b.layer) {
          return a.layer > b.layer;
        }
        return std::abs(wrap_angle(a.bearing_rad - heading_rad)) < std::abs(wrap_angle(b.bearing_rad - heading_rad));
      });
  return best == goals.end() ? std::nullopt : std::optional(static_cast<std::size_t>(best - goals.begin()));
}

}  // namespace seeker::fleet
