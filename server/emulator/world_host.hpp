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
  std::uint64_t world_id = 1;  ///< tells this run from others
  bool lockstep = true;        ///< the world waits for its robots; false: it goes with the wall clock
  double speed = 0.0;          ///< told to the robots
};

/// Serves what robots ask of their devices. A robot that is gone stands still where it is; its devices stay as they
/// were, and it may come back. What one robot asks for never changes what another one senses.
class WorldHost {
 public:
  WorldHost(drivers::SharedDevices devices, HostParams params);

  /// A robot's first request; the answer is which robot it is. kUnsupportedVersion, kNotFound; kBusy when another
  /// program is that robot already (the same program may come again).
  [[nodiscard]] Result<std::size_t> enter(const v1::EmulatorHello& hello);
  [[nodiscard]] v1::EmulatorReply welcome(std::uint64_t request_id) const;
  void leave(std::size_t robot);

  /// The reply; nothing for advance, which is answered when the world has come there (see go_on()).
  [[nodiscard]] std::optional<v1::EmulatorReply> handle(std::size_t robot, const v1::EmulatorRequest& request);

  /// Where the world may go on to now; nothing when it must wait.
  [[nodiscard]] std::optional<RobotTime> next() const;
  /// Lets the world go on; the replies to those that waited for it.
  [[nodiscard]] std::vector<std::pair<std::size_t, v1::EmulatorReply>> go_on(RobotTime to);

  [[nodiscard]] const sim::SharedWorld& world() const { return *devices_.world; }
  [[nodiscard]] std::size_t robots() const { return robots_.size(); }

 private:
  struct Robot {
    std::optional<std::uint64_t> instance;  ///< of the program that is it now
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
