#include "server/sim/shared_world.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace seeker::sim {
namespace {

constexpr Duration kMaxStep = std::chrono::milliseconds(10);

Status check(const World& world, const std::vector<RobotPlace>& places) {
  if (const Status valid = validate(world); !valid) {
    return valid;
  }
  if (places.empty() || places.size() > kMaxRobotsInWorld) {
    return fail(Errc::kInvalidArgument, "a world holds 1 to " + std::to_string(kMaxRobotsInWorld) + " robots, not " +
                                            std::to_string(places.size()));
  }
  for (const RobotPlace& place : places) {
    if (const Status valid = validate(place.model); !valid) {
      return valid;
    }
    if (place.start >= world.starts.size()) {
      return fail(Errc::kInvalidArgument, "world '" + world.name + "' has " + std::to_string(world.starts.size()) +
                                              " start poses; number " + std::to_string(place.start) +
                                              " is not one of them");
    }
  }
  return {};
}

}  // namespace

SharedWorld::SharedWorld(World world) : world_(std::move(world)) {
  if (world_.people_walk) {
    walkers_.reserve(world_.people.size());
    for (std::size_t i = 0; i < world_.people.size(); ++i) {
      walkers_.emplace_back(world_.people[i], i);
    }
  }
}

Result<std::shared_ptr<SharedWorld>> SharedWorld::create(World world, std::vector<RobotPlace> places) {
  if (const Status valid = check(world, places); !valid) {
    return tl::unexpected<Error>(valid.error());
  }
  const std::shared_ptr<SharedWorld> shared(new SharedWorld(std::move(world)));
  for (RobotPlace& place : places) {
    if (const Status added = shared->add(std::move(place)); !added) {
      return tl::unexpected<Error>(added.error());
    }
  }
  return shared;
}

Status SharedWorld::add(RobotPlace place) {
  const Pose2& world_T_start = world_.starts[place.start];
  const double reach_m = place.model.radius_m;
  const HeightBand body = body_band(place.model);
  robots_.push_back(
      std::make_unique<RobotInWorld>(world_, std::move(place.model), place.seed, world_T_start, robots_.size()));
  show_surroundings();
  const Scene& scene = robots_.back()->scene();
  if (scene.clearance_m(world_T_start.translation(), 2.0 * reach_m, body) < reach_m) {
    return fail(Errc::kInvalidArgument, "world '" + world_.name + "': start " + std::to_string(place.start) +
                                            " leaves no room for a robot of radius " + std::to_string(reach_m) +
                                            " m; move it away from walls, furniture and other robots");
  }
  return {};
}

void SharedWorld::advance(Duration period) {
  while (period > Duration::zero()) {
    const Duration length = std::min(period, kMaxStep);
    step(length);
    period -= length;
  }
  if (robots_.size() > 1) {
    show_surroundings();
  }
}

void SharedWorld::step(Duration period) {
  if (!walkers_.empty()) {
    std::vector<Disc> bodies;
    bodies.reserve(robots_.size());
    for (const auto& robot : robots_) {
      bodies.push_back(robot->disc());
    }
    for (Walker& walker : walkers_) {
      walker.step(bodies, to_seconds(period));
    }
  }
  if (!walkers_.empty() || robots_.size() > 1) {
    show_surroundings();
  }
  for (const auto& robot : robots_) {
    robot->step(period);
  }
  now_ += period;
}

void SharedWorld::show_surroundings() {
  std::vector<Disc> people;
  people.reserve(walkers_.size() + robots_.size());
  for (const Walker& walker : walkers_) {
    people.push_back(walker.disc());
  }
  for (const auto& robot : robots_) {
    std::vector<Disc> around = people;
    for (const auto& other : robots_) {
      if (other != robot) {
        around.push_back(other->disc());
      }
    }
    robot->set_surroundings(std::move(around));
  }
}

}  // namespace seeker::sim
