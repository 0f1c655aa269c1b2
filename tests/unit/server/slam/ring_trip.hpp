/// \file
/// A round trip through a ring of corridors, for tests of line SLAM.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "rooms.hpp"
#include "server/slam/line_slam.hpp"

namespace seeker::slam {

/// A ring of corridors of 2 m round a block of 12 x 8 m, with three alcoves that distinguish its sides.
inline std::vector<Wall> ring() {
  std::vector<Wall> walls = box(0.0, 0.0, 16.0, 12.0);
  const auto block = box(2.0, 2.0, 14.0, 10.0);
  walls.insert(walls.end(), block.begin(), block.end());
  for (const auto& piece :
       {box(4.0, 0.0, 4.6, 0.4), box(15.5, 5.0, 16.0, 6.2), box(9.0, 11.6, 10.0, 12.0), box(0.0, 7.0, 0.3, 8.5)}) {
    walls.insert(walls.end(), piece.begin(), piece.end());
  }
  return walls;
}

/// A robot on a round trip through the ring; its wheels say 3 % too much and drift to the left.
class Trip {
 public:
  explicit Trip(std::uint64_t seed, const Pose2& start = {3.0, 1.0, 0.0}) : rng_(seed), truth_(start), start_(start) {}

  /// Drives towards the next corner of the ring.
  void step() {
    static const std::array<Point2, 4> kCorners{Point2(15.0, 1.0), Point2(15.0, 11.0), Point2(1.0, 11.0),
                                                Point2(1.0, 1.0)};
    if ((kCorners.at(corner_) - truth_.translation()).norm() < 0.5) {
      corner_ = (corner_ + 1) % kCorners.size();
    }
    const double omega_rad_s = std::clamp(bearing_to(truth_, kCorners.at(corner_)), -0.6, 0.6);
    move(integrate({std::abs(omega_rad_s) > 0.4 ? 0.1 : 0.5, omega_rad_s}, kTick_s));
  }
  void move(const Pose2& motion) {
    truth_ = truth_ * motion;
    odom_ = odom_ * Pose2{1.03 * motion.x_m + rng_.normal(0.002), motion.y_m,
                          motion.theta_rad + 0.01 * motion.x_m + rng_.normal(0.002)};
    path_m_ += std::hypot(motion.x_m, motion.y_m);
    time_s_ += kTick_s;
  }
  Status feed(LineSlam& slam) {
    const Status predicted = slam.predict(odom_, robot_time_s(time_s_));
    return predicted ? slam.update(scan()) : predicted;
  }
  [[nodiscard]] LaserScan scan() { return scan_at(walls_, truth_, time_s_, rng_); }
  [[nodiscard]] const Pose2& truth() const { return truth_; }
  [[nodiscard]] const Pose2& odom() const { return odom_; }
  [[nodiscard]] double path_m() const { return path_m_; }
  [[nodiscard]] RobotTime time() const { return robot_time_s(time_s_); }

  static constexpr double kTick_s = 0.1;

 private:
  Rng rng_;
  std::vector<Wall> walls_ = ring();
  Pose2 truth_;
  Pose2 start_;
  Pose2 odom_;
  std::size_t corner_ = 0;
  double path_m_ = 0.0;
  double time_s_ = 0.0;
};

inline void drive(Trip& trip, LineSlam& slam, double path_m) {
  const double end_m = trip.path_m() + path_m;
  while (trip.path_m() < end_m) {
    ASSERT_TRUE(trip.feed(slam));
    trip.step();
  }
}

}  // namespace seeker::slam
