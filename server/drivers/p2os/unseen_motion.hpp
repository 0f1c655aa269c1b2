/// \file
/// What a base does while nothing reaches it (protocols 1.4): it drives on as it was commanded until its own watchdog
/// halts it.
#pragma once

#include "common/core/pose2.hpp"
#include "common/core/time.hpp"
#include "server/drivers/p2os/base_limits.hpp"

namespace seeker::drivers {

/// Where a base is in `unheard` after it had `commanded`, in its frame of that moment: halfway to the farthest place,
/// which lies along the arc of the command for `watchdog` and the braking after it. Whether the base was halted at once
/// or by its watchdog, it is no farther than the other half from here.
[[nodiscard]] Pose2 halfway_unseen(const Twist2& commanded, Duration unheard, Duration watchdog,
                                   const BaseLimits& limits);

}  // namespace seeker::drivers
