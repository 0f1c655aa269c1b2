/// \file
/// Time of one decision with N segments in the map, rooms of 4 x 4 m in rows. Of the one-step rule (spec S1.11): all of
/// them are in one filter; what is in view stays the same, so that the growth with N is what a larger building costs.
/// Of the tour: every second room was looked at from its middle, so that the tour leads to half of the rooms.
#include <algorithm>
#include <cmath>
#include <iterator>

#include <benchmark/benchmark.h>

#include "server/explore/make_strategy.hpp"
#include "server/explore/one_step.hpp"
#include "server/nav/occupancy_map.hpp"
#include "server/slam/sp_map.hpp"
#include "tests/support/toy_world.hpp"

namespace {

using namespace seeker;  // NOLINT: a benchmark program

constexpr double kRoom_m = 4.0;
constexpr std::size_t kPerRoom = 8;  ///< a door in each wall cuts it in two
constexpr std::size_t kPerRow = 10;

/// The part of a room's wall, seen from inside: x runs from its left end to its right end.
MapSegment piece(std::size_t id, const Pose2& map_T_wall, double from_m, double to_m, bool left_real) {
  MapSegment segment;
  segment.id = id;
  segment.map_T_segment = map_T_wall * Pose2{0.5 * (from_m + to_m), 0.0, 0.0};
  segment.length_m = to_m - from_m;
  segment.left_real = left_real;
  segment.right_real = !left_real;
  segment.covariance << 1e-4, 0.0, 0.0, 1e-4;
  segment.hits = 10;
  return segment;
}

Pose2 middle_of(std::size_t room) {
  const std::size_t column = room % kPerRow;
  const std::size_t row = room / kPerRow;
  return {kRoom_m * static_cast<double>(column), kRoom_m * static_cast<double>(row), 0.0};
}

std::vector<MapSegment> rooms(std::size_t count) {
  std::vector<MapSegment> segments;
  segments.reserve(count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t side = (k % kPerRoom) / 2;
    const Pose2 middle = middle_of(k / kPerRoom) * Pose2{0.0, 0.0, 0.5 * kPi * static_cast<double>(side)};
    const Pose2 wall = middle * Pose2{0.0, 0.5 * kRoom_m - 0.05, 0.0};
    segments.push_back(k % 2 == 0 ? piece(k + 1, wall, -1.9, -0.5, true) : piece(k + 1, wall, 0.5, 1.9, false));
  }
  return segments;
}

slam::SpMap filter_of(const std::vector<MapSegment>& segments) {
  slam::SpMapParams params;
  params.features.real_scans = 1;
  slam::SpMap map({}, 1e-4 * Matrix3::Identity(), params);
  std::vector<lines::SegmentObservation> seen;
  slam::Association all_new;
  seen.reserve(segments.size());
  all_new.matches.resize(segments.size());
  for (const MapSegment& segment : segments) {
    lines::SegmentObservation one;
    one.base_T_segment = segment.map_T_segment;
    one.length_m = segment.length_m;
    one.real = {segment.left_real, segment.right_real};
    one.covariance << 1e-4, 0.0, 0.0, 1e-4;
    one.end_sigma_m = {0.03, 0.03};
    one.points = 40;
    seen.push_back(one);
  }
  map.update(seen, all_new);
  return map;
}

/// Free floor inside the first room, so that the floor map takes part.
nav::OccupancyMap floor_of_first_room() {
  nav::OccupancyMap map;
  LaserScan scan;
  scan.angle_min_rad = -kPi;
  scan.angle_step_rad = deg_to_rad(0.5);
  scan.range_max_m = 8.0;
  for (std::size_t k = 0; k < 720; ++k) {
    const double a = scan.angle_rad(k);
    scan.ranges_m.push_back(static_cast<float>(1.95 / std::max(std::abs(std::cos(a)), std::abs(std::sin(a)))));
  }
  for (int k = 0; k < 5; ++k) {
    (void)map.integrate(scan, {});
  }
  return map;
}

/// The floor that a robot knows that has looked round in the middle of every second room.
nav::OccupancyMap floor_of_every_second_room(const std::vector<MapSegment>& segments) {
  std::vector<testing::Wall> walls;
  std::transform(segments.begin(), segments.end(), std::back_inserter(walls), [](const MapSegment& segment) {
    return testing::Wall{segment.left(), segment.right()};
  });
  nav::OccupancyMap map;
  for (std::size_t room = 0; room * kPerRoom < segments.size(); ++room) {
    const Pose2 pose = middle_of(room);
    if ((room % kPerRow + room / kPerRow) % 2 != 0) {
      continue;
    }
    LaserScan scan;
    scan.angle_min_rad = -kPi;
    scan.angle_step_rad = deg_to_rad(0.5);
    scan.range_max_m = 8.0;
    for (std::size_t k = 0; k < 720; ++k) {
      const Point2 direction(std::cos(scan.angle_rad(k)), std::sin(scan.angle_rad(k)));
      const double range_m = testing::ray_to_walls(walls, pose.translation(), direction, scan.range_max_m);
      scan.ranges_m.push_back(range_m < scan.range_max_m ? static_cast<float>(range_m) : kNoReturn);
    }
    for (int k = 0; k < 5; ++k) {
      (void)map.integrate(scan, pose);
    }
  }
  return map;
}

/// The first decision of an exploration: floor, openings and tour from nothing.
void decide_tour(benchmark::State& state) {
  const std::vector<MapSegment> segments = rooms(static_cast<std::size_t>(state.range(0)));
  const nav::OccupancyMap map = floor_of_every_second_room(segments);
  const Pose2 pose{0.3, 0.2, 0.4};
  double places = 0.0;
  for (auto _ : state) {
    nav::FloorSource floors({}, {}, 0.2, 1.0);
    floors.attend(map, pose, {});
    const explore::StrategyInput input{
        {{}, pose, nullptr, nullptr, floors}, {}, 1e-6 * Matrix3::Identity(), segments, 1, {}};
    const auto strategy = explore::make_strategy(explore::Strategy::kTour, {});
    const explore::StrategyStep step = strategy->step(input);
    places = step.decision ? static_cast<double>(step.decision->candidates.size()) : 0.0;
  }
  state.counters["places"] = places;
}

void decide(benchmark::State& state) {
  const std::vector<MapSegment> segments = rooms(static_cast<std::size_t>(state.range(0)));
  const slam::SpMap filter = filter_of(segments);
  const nav::OccupancyMap map = floor_of_first_room();
  nav::FloorSource floors({}, {}, 0.2, 1.0);
  const Pose2 pose{0.3, 0.2, 0.4};
  floors.attend(map, pose, {});
  const explore::StrategyInput input{{{}, pose, nullptr, nullptr, floors}, {}, Matrix3::Zero(), segments, 1,
                                     slam::LocalBelief{&filter, {}}};
  explore::OneStepParams params;
  params.use_floor = state.range(1) != 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(explore::choose_one_step(input, segments, params));
  }
}

BENCHMARK(decide)->ArgsProduct({{50, 200, 800}, {0, 1}})->ArgNames({"N", "floor"})->Unit(benchmark::kMillisecond);

BENCHMARK(decide_tour)->Arg(50)->Arg(200)->Arg(800)->ArgName("N")->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
