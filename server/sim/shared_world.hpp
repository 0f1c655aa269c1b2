/// \file
/// A world with several robots, which see and block each other.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "common/core/result.hpp"
#include "common/core/time.hpp"
#include "server/sim/body_motion.hpp"
#include "server/sim/robot_in_world.hpp"
#include "server/sim/world.hpp"

namespace seeker::sim {

inline constexpr std::size_t kMaxRobotsInWorld = 16;

/// A robot of a shared world and its start.
struct RobotPlace {
  RobotModel model;
  std::uint64_t seed = 1;
  std::size_t start = 0;  ///< index into World::starts
};

/// A deterministic world: all robots move from the state before the step, and each draws its own noise, so that neither
/// the order of the calls nor the number of robots out of sight changes what one of them senses. Between two calls of
/// advance() every robot may be used by a separate thread.
class SharedWorld {
 public:
  /// Makes the world. It fails when the world or a model is invalid, when there are no robots or too many, or when a
  /// robot has no room at its start, other robots included.
  [[nodiscard]] static Result<std::shared_ptr<SharedWorld>> create(World world, std::vector<RobotPlace> places);

  SharedWorld(const SharedWorld&) = delete;
  SharedWorld& operator=(const SharedWorld&) = delete;
  ~SharedWorld() = default;

  /// Advances the simulated time, in steps of at most 10 ms.
  void advance(Duration period);
  [[nodiscard]] RobotTime now() const { return now_; }
  [[nodiscard]] const World& world() const { return world_; }
  [[nodiscard]] std::size_t size() const { return robots_.size(); }
  [[nodiscard]] RobotInWorld& robot(std::size_t index) { return *robots_[index]; }
  [[nodiscard]] const RobotInWorld& robot(std::size_t index) const { return *robots_[index]; }

 private:
  explicit SharedWorld(World world);
  [[nodiscard]] Status add(RobotPlace place);
  void step(Duration period);
  /// Gives every robot the present places of all others and of the people.
  void show_surroundings();

  World world_;
  std::vector<std::unique_ptr<RobotInWorld>> robots_;
  std::vector<Walker> walkers_;
  RobotTime now_;
};

}  // namespace seeker::sim
