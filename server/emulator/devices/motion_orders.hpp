/// \file
/// Commands of a client that move a base or limit its motion (protocols 1.4), carried out on its motion control.
#pragma once

#include "common/core/pose2.hpp"
#include "server/emulator/devices/p2os_device_params.hpp"
#include "server/emulator/devices/pioneer_motion.hpp"
#include "server/protocols/p2os/command.hpp"
#include "server/protocols/p2os/pioneer_model.hpp"

namespace seeker::emulator {

/// False: it is no command of motion. `odom_T_base` is the pose now.
bool obey_motion(const p2os::Command& command, const p2os::PioneerModel& model, const Pose2& odom_T_base,
                 PioneerMotion& motion);
/// False: it sets no limit, or to zero.
bool obey_limit(const p2os::Command& command, const P2osDeviceParams& params, PioneerLimits& limits);

}  // namespace seeker::emulator
