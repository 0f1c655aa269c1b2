/// \file
/// The world of seeker-emulator and its robots, as requests and replies: no sockets, no threads, no clock.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "common/core/result.hpp"
#include "seeker/v1/emulator.pb.h"
#include "server/drivers/sim/sim_devices.hpp"
#include "server/drivers/sim/tick_gate.hpp"

namespace seeker::emulator {

struct HostParams {
  std::uint64_t world_id = 1;  ///< distinguishes this run from others
  bool lockstep = true;        ///< true: the world waits for its robots; false: it runs with the wall clock
  double speed = 0.0;          ///< robot seconds per wall second, as reported to the robots
};

/// Serves the requests of robots to their devices. A robot whose program is gone stands still; its devices keep their
/// state, and the program may come back. The requests of one robot never change the readings of another.
class WorldHost {
 public:
  WorldHost(drivers::SharedDevices devices, HostParams params);

  /// Handles the first request of a robot program and returns the index of its robot. kUnsupportedVersion, kNotFound;
  /// kBusy when another program is that robot already (the same program may come again).
  [[nodiscard]] Result<std::size_t> enter(const v1::EmulatorHello& hello);
  [[nodiscard]] v1::EmulatorReply welcome(std::uint64_t request_id) const;
  void leave(std::size_t robot);

  /// Handles a request and returns the reply; std::nullopt for advance, which go_on() answers when the world is there.
  [[nodiscard]] std::optional<v1::EmulatorReply> handle(std::size_t robot, const v1::EmulatorRequest& request);

  /// The time to which the world may advance now; std::nullopt when it must wait.
  [[nodiscard]] std::optional<RobotTime> next() const;
  /// Advances the world and returns the replies to the robots that have waited for it.
  [[nodiscard]] std::vector<std::pair<std::size_t, v1::EmulatorReply>> go_on(RobotTime to);

  [[nodiscard]] const sim::SharedWorld& world() const { return *devices_.world; }
  [[nodiscard]] std::size_t robots() const { return robots_.size(); }

 private:
  struct Robot {
    std::optional<std::uint64_t> instance;  ///< of the program that runs this robot now
    std::uint64_t advance_id = 0;           ///< request that waits for the world; 0: none
  };
  [[nodiscard]] Status serve(drivers::SimDevices& robot, const v1::EmulatorRequest& request, v1::EmulatorReply& reply);
  [[nodiscard]] Status advance(std::size_t robot, const v1::EmulatorRequest& request);
  [[nodiscard]] v1::EmulatorReply answer(std::uint64_t id) const;

  drivers::SharedDevices devices_;
  HostParams params_;
  drivers::TickGate gate_;
  std::vector<Robot> robots_;
};

}  // namespace seeker::emulator
