/// \file
/// The toy world for closed-loop tests of the search: with a recogniser that sees targets in range and in the line of
/// sight.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "common/core/angle.hpp"
#include "common/core/polygon.hpp"
#include "server/nav/occupancy_map.hpp"
#include "server/search/search_mission.hpp"
#include "tests/support/toy_world.hpp"

namespace seeker::search {

using seeker::testing::box;
using seeker::testing::Wall;

struct ToyWorld : seeker::testing::ToyWorld {
  double recognise_range_m = 2.5;
  double recognise_from_m = 0.0;  ///< nearer it is not recognised: a mistake of the recogniser looks like that
  double recognise_rate = 0.9;
};

/// What a closed-loop run left behind.
struct ToyRun {
  std::optional<SearchEnd> end;
  std::vector<SearchEvent> events;
  std::vector<Detection> detections;
  CoverageSummary summary;
  GridLists lists;
  double path_m = 0.0;
  double seconds = 0.0;
  double least_clearance_m = 100.0;
  Pose2 pose;
  int images = 0;
  int stops = 0;  ///< times that the robot came to rest
  bool left_bound = false;
};

class ToyRobot : public seeker::testing::ToyBase {
 public:
  ToyRobot(const ToyWorld& world, const Pose2& start, bool laser, std::uint64_t seed)
      : ToyBase(world, start, seed), recogniser_(world), laser_fitted_(laser) {}

  [[nodiscard]] std::vector<vision::Sighting> recognise() {
    if (phantom) {
      return {*std::exchange(phantom, std::nullopt)};
    }
    if (!world_.target) {
      return {};
    }
    const Point2 to = *world_.target - pose_.translation();
    const double heading = std::atan2(to.y(), to.x());
    const bool clear = world_.ray(pose_.translation(), heading, 10.0) > to.norm() - 0.2;
    if (!clear || to.norm() > recogniser_.recognise_range_m || to.norm() < recogniser_.recognise_from_m ||
        rng_.uniform() > recogniser_.recognise_rate) {
      return {};
    }
    vision::Sighting sighting;
    sighting.score = 0.8;
    sighting.bearing_base_rad = wrap_angle(heading - pose_.theta_rad + rng_.normal(0.02));
    return {sighting};
  }

  std::optional<vision::Sighting> phantom;  ///< recognised in the next picture, and never again
  MapViews map_views;                       ///< handed to the mission
  std::function<void(double t_s)> between;  ///< called before each step: people, who are walls of world()
  std::size_t pictures_at_once = 1;         ///< that answer for one
  bool held = false;                        ///< the base does not move for any command

  ToyRun run(SearchMission& mission, double limit_s, const std::optional<Polygon>& bound = {}) {
    ToyRun out;
    nav::OccupancyMap map;
    for (int tick = 0; tick * 0.1 < limit_s; ++tick) {
      const RobotTime now = robot_time_s(tick * 0.1);
      if (between) {
        between(tick * 0.1);
      }
      const SonarScan sonar_scan = sonar(now);
      const LaserScan laser_scan = laser(now);
      if (laser_fitted_) {
        (void)map.integrate(laser_scan, pose_);
      } else {
        (void)map.integrate(sonar_scan, pose_);
      }
      const LaserScan* laser_or_none = laser_fitted_ ? &laser_scan : nullptr;
      SearchStep step =
          mission.step({now, pose_, Matrix3::Identity() * 1e-6, &sonar_scan, laser_or_none, map, 0, map_views});
      out.events.insert(out.events.end(), step.events.begin(), step.events.end());
      out.seconds = to_seconds(now);
      if (step.end) {
        out.end = step.end;
        break;
      }
      if (step.wants_image) {
        ++out.images;
        if (pictures_at_once == 1) {
          mission.on_sightings(now, pose_, recognise(), laser_or_none, &sonar_scan);
        } else {
          mission.on_looks(std::vector<Look>(pictures_at_once,
                                             {now, pose_, Matrix3::Zero(), recognise(), laser_or_none, &sonar_scan}));
        }
      }
      const double before_m_s = twist_.v_m_s;
      drive(held ? Twist2{} : step.command);
      out.stops += before_m_s > 0.0 && twist_.v_m_s <= 0.0 ? 1 : 0;
      out.least_clearance_m = std::min(out.least_clearance_m, world_.clearance(pose_.translation()));
      out.left_bound = out.left_bound || (bound && !contains(*bound, pose_.translation()));
    }
    out.detections = mission.detections();
    out.summary = mission.summary();
    out.lists = mission.lists();
    out.path_m = mission.path_length_m();
    out.pose = pose_;
    return out;
  }

 private:
  ToyWorld recogniser_;  ///< its numbers
  bool laser_fitted_;
};

inline std::shared_ptr<const ControlTable> shared_table() {
  static const auto table = std::make_shared<const ControlTable>(*ControlTable::create());
  return table;
}

/// Two rooms of 5 x 5 m joined by a door of 1.2 m, with a box of furniture in the second.
inline ToyWorld furnished_rooms() {
  ToyWorld world;
  world.walls = box(0, 0, 10.2, 5);
  world.walls.push_back({{5.1, 0.0}, {5.1, 1.9}});
  world.walls.push_back({{5.1, 3.1}, {5.1, 5.0}});
  for (const Wall& wall : box(7.2, 2.0, 8.0, 2.8)) {
    world.walls.push_back(wall);
  }
  return world;
}

inline SearchMission mission_of(Strategy strategy, OnFound on_found = OnFound::kApproach,
                                nav::ForbiddenAreas areas = {}, const SearchParams& params = {}) {
  SearchRequest request;
  request.targets = {{"box", 0.4, 0.4, 0.3}};
  request.strategy = strategy;
  request.on_found = on_found;
  request.areas = std::move(areas);
  auto mission = SearchMission::create(request, params, shared_table());
  EXPECT_TRUE(mission.has_value());
  return std::move(*mission);
}

/// With a robot that drives at up to `max_v_m_s`.
inline SearchMission planned_search(double max_v_m_s = SearchParams{}.plan.follower.max_v_m_s) {
  SearchParams params;
  params.plan.follower.max_v_m_s = max_v_m_s;
  return mission_of(Strategy::kPlan, OnFound::kApproach, {}, params);
}

inline void print(const char* name, const ToyRun& run) {
  std::cout << name << ": " << (run.end ? run.end->cause : "no end") << "; " << run.seconds << " s, " << run.path_m
            << " m, clearance " << run.least_clearance_m << " m, images " << run.images << '\n';
}

}  // namespace seeker::search
