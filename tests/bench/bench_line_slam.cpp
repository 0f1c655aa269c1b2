// What a scan costs line SLAM in a small and in a large building: the goal is a flat line from 200 to 5000 segments.
#include <cmath>
#include <vector>

#include <benchmark/benchmark.h>

#include "common/core/angle.hpp"
#include "common/core/rng.hpp"
#include "server/slam/line_slam.hpp"

namespace {

using namespace seeker;  // NOLINT(google-build-using-namespace): a program of its own

constexpr std::uint64_t kSeed = 1;
constexpr double kCorridor_m = 100.0;  ///< length of one
constexpr double kPitch_m = 4.0;       ///< from one to the next
constexpr double kHalfWidth_m = 1.2;
constexpr double kNiche_m = 2.5;  ///< mean distance of niches along a wall
constexpr double kStep_m = 0.1;   ///< between scans
constexpr double kRangeMax_m = 12.0;
constexpr double kSigma_m = 0.01;
constexpr int kBeams = 361;

struct Wall {
  Point2 a;
  Point2 b;
};

/// Parallel corridors joined at alternate ends: the robot goes through all of them as a weaver's shuttle does. Niches
/// of random size tell places apart. 25 corridors are 10,000 m2.
class Building {
 public:
  explicit Building(std::uint64_t seed) : rng_(seed) {}

  /// Walls of corridor k, made when first asked for.
  const std::vector<Wall>& corridor(std::size_t k) {
    while (corridors_.size() <= k) {
      corridors_.push_back(make(static_cast<double>(corridors_.size()) * kPitch_m));
    }
    return corridors_[k];
  }

 private:
  std::vector<Wall> make(double y_m) {
    std::vector<Wall> walls;
    for (const double side : {-1.0, 1.0}) {
      double x_m = 0.0;
      while (x_m < kCorridor_m) {
        const double next_m = std::min(kCorridor_m, x_m + rng_.uniform(0.5 * kNiche_m, 1.5 * kNiche_m));
        const double depth_m = rng_.uniform(0.0, 0.4);
        const double width_m = rng_.uniform(0.5, 1.0);
        const double wall_y = y_m + side * kHalfWidth_m;
        const double back_y = wall_y + side * depth_m;
        walls.push_back({{x_m, wall_y}, {next_m, wall_y}});
        if (next_m + width_m < kCorridor_m) {
          walls.push_back({{next_m, wall_y}, {next_m, back_y}});
          walls.push_back({{next_m, back_y}, {next_m + width_m, back_y}});
          walls.push_back({{next_m + width_m, back_y}, {next_m + width_m, wall_y}});
        }
        x_m = next_m + width_m;
      }
    }
    return walls;
  }

  Rng rng_;
  std::vector<std::vector<Wall>> corridors_;
};

double cast(const std::vector<Wall>& walls, const Point2& from, double angle_rad) {
  const Point2 d(std::cos(angle_rad), std::sin(angle_rad));
  double nearest = kRangeMax_m;
  for (const Wall& wall : walls) {
    const Point2 e = wall.b - wall.a;
    const double cross = d.x() * e.y() - d.y() * e.x();
    if (std::abs(cross) < 1e-12) {
      continue;
    }
    const Point2 w = wall.a - from;
    const double t = (w.x() * e.y() - w.y() * e.x()) / cross;
    const double u = (w.x() * d.y() - w.y() * d.x()) / cross;
    if (t > 0.0 && u >= 0.0 && u <= 1.0 && t < nearest) {
      nearest = t;
    }
  }
  return nearest;
}

/// Drives to the end of each corridor, turns into the next one and comes back.
class Shuttle {
 public:
  Shuttle() : building_(kSeed), rng_(kSeed + 1) {}

  /// One step and its scan.
  LaserScan step() {
    constexpr double kTurn_rad = 0.15;
    const Point2 goal = waypoint(next_);
    if ((goal - pose_.translation()).norm() < kStep_m) {
      ++next_;
    }
    const double off_rad = bearing_to(pose_, waypoint(next_));
    const Pose2 motion = std::abs(off_rad) > kTurn_rad ? Pose2{0.0, 0.0, std::copysign(kTurn_rad, off_rad)}
                                                       : Pose2{kStep_m, 0.0, off_rad};
    pose_ = pose_ * motion;
    odom_ = odom_ * Pose2{motion.x_m + rng_.normal(0.002), 0.0, motion.theta_rad + rng_.normal(0.001)};
    time_s_ += 0.2;
    find_near_walls();
    return scan();
  }
  [[nodiscard]] const Pose2& odom() const { return odom_; }
  [[nodiscard]] RobotTime time() const { return robot_time_s(time_s_); }

 private:
  /// Ends of the corridors in the order of the tour.
  [[nodiscard]] static Point2 waypoint(std::size_t k) {
    const std::size_t corridor = (k + 1) / 2;
    const bool east = k % 4 == 0 || k % 4 == 1;
    return {east ? kCorridor_m + 1.0 : -1.0, static_cast<double>(corridor) * kPitch_m};
  }
  void find_near_walls() {
    near_.clear();
    const auto row = static_cast<std::size_t>(std::max(0.0, pose_.y_m / kPitch_m));
    for (std::size_t k = row == 0 ? 0 : row - 1; k <= row + 1; ++k) {
      for (const Wall& wall : building_.corridor(k)) {
        if (std::abs(0.5 * (wall.a.x() + wall.b.x()) - pose_.x_m) < kRangeMax_m + kNiche_m) {
          near_.push_back(wall);
        }
      }
    }
  }
  LaserScan scan() {
    LaserScan scan;
    scan.stamp = time();
    scan.angle_min_rad = -kPi / 2.0;
    scan.angle_step_rad = kPi / (kBeams - 1);
    scan.range_max_m = kRangeMax_m;
    scan.ranges_m.reserve(kBeams);
    for (std::size_t k = 0; k < kBeams; ++k) {
      const double range_m = cast(near_, pose_.translation(), pose_.theta_rad + scan.angle_rad(k));
      scan.ranges_m.push_back(range_m < kRangeMax_m ? static_cast<float>(range_m + rng_.normal(kSigma_m)) : kNoReturn);
    }
    return scan;
  }

  Building building_;
  Rng rng_;
  std::size_t next_ = 0;
  Pose2 pose_{2.0, 0.0, 0.0};
  Pose2 odom_;
  double time_s_ = 0.0;
  std::vector<Wall> near_;
};

/// Segments of all local maps, before what several of them show is put together: what memory and search depend on.
void scan_in_a_building(benchmark::State& state) {
  const auto wanted = static_cast<std::size_t>(state.range(0));
  constexpr int kCheckEvery = 100;
  Shuttle shuttle;
  slam::LineSlam slam;
  int steps = 0;
  std::size_t segments = 0;
  const auto feed = [&](const LaserScan& scan) {
    (void)slam.predict(shuttle.odom(), shuttle.time());
    (void)slam.update(scan);
  };
  while (segments < wanted) {
    feed(shuttle.step());
    if (++steps % kCheckEvery == 0) {
      segments = slam.map().segments.size();
    }
  }
  for (auto _ : state) {  // NOLINT(clang-analyzer-deadcode.DeadStores): the library's idiom
    state.PauseTiming();
    const LaserScan scan = shuttle.step();
    state.ResumeTiming();
    feed(scan);
  }
  state.counters["segments"] = static_cast<double>(segments);
  state.counters["way_m"] = steps * kStep_m;
}
BENCHMARK(scan_in_a_building)->Arg(200)->Arg(1000)->Arg(5000)->Iterations(1000)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
