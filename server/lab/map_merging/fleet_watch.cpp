#include "server/lab/map_merging/fleet_watch.hpp"

#include <array>
#include <cstdio>
#include <optional>
#include <utility>

#include "common/core/angle.hpp"
#include "common/core/text.hpp"

namespace seeker::lab {
namespace {

/// Bodies so near to each other are what touched.
constexpr double kTouch_m = 0.03;

std::string speed_of(const Twist2& velocity) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.2f m/s %.2f rad/s", velocity.v_m_s, velocity.omega_rad_s);
  return text.data();
}

}  // namespace

void FleetWatch::add(std::string id, const app::RobotLoop& loop, const sim::Simulation& simulation) {
  Watched robot;
  robot.id = std::move(id);
  robot.loop = &loop;
  robot.simulation = &simulation;
  robots_.push_back(std::move(robot));
}

void FleetWatch::look(RobotTime now) {
  for (std::size_t k = 0; k < robots_.size(); ++k) {
    check_contacts(k, now);
    check_activity(robots_[k], now);
  }
  for (Watched& robot : robots_) {
    robot.velocity = robot.simulation->truth().velocity;
  }
  last_ = now;
}

void FleetWatch::check_contacts(std::size_t index, RobotTime now) {
  Watched& robot = robots_[index];
  const sim::GroundTruth truth = robot.simulation->truth();
  if (std::exchange(robot.contacts, truth.contacts) == truth.contacts) {
    return;
  }
  const double radius_m = robot.simulation->model().radius_m;
  std::string what = "an object of the building";
  bool is_robot = false;
  for (std::size_t k = 0; k < robots_.size(); ++k) {
    const Watched& other = robots_[k];
    const Pose2 world_T_other = other.simulation->truth().world_T_base;
    const double gap_m = distance_m(truth.world_T_base, world_T_other) - radius_m - other.simulation->model().radius_m;
    if (k != index && gap_m < kTouch_m) {
      is_robot = true;
      const double bearing_rad = bearing_to(truth.world_T_base, world_T_other.translation());
      what = other.id + " at " + std::to_string(static_cast<int>(rad_to_deg(bearing_rad))) + " degrees, that drove " +
             speed_of(other.velocity);
    }
  }
  robot_touches_ += is_robot ? 1 : 0;
  note(now, robot,
       "touched at " + text(truth.world_T_base.translation()) + " with " + speed_of(robot.velocity) + ": " + what);
}

void FleetWatch::check_activity(Watched& robot, RobotTime now) {
  const std::optional<api::MissionStatus>& mission = robot.loop->missions().last();
  if (!mission || robot.ended) {
    return;
  }
  if (mission->end) {
    robot.ended = true;
    first_end_s_ = first_end_s_ > 0.0 ? first_end_s_ : to_seconds(now);
    note(now, robot, "ended: " + mission->end->cause);
    return;
  }
  waited_s_ += mission->phase == "wait" ? to_seconds(now - last_) : 0.0;
  if (mission->activity != robot.activity) {
    robot.activity = mission->activity;
    note(now, robot, mission->phase + ": " + mission->activity);
  }
}

void FleetWatch::note(RobotTime now, const Watched& robot, const std::string& what) {
  std::array<char, 32> time{};
  std::snprintf(time.data(), time.size(), "%7.1f ", to_seconds(now));
  const Point2 p_world = robot.simulation->truth().world_T_base.translation();
  log_ += time.data() + robot.id + " at " + text(p_world) + " " + what + "\n";
}

}  // namespace seeker::lab
