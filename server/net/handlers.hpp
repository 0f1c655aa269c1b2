/// \file
/// One handler per request: message to value, call the robot, value to message.
#pragma once

#include <memory>

#include "common/core/time.hpp"
#include "seeker/v1/calls.pb.h"

namespace seeker::server_net {

class Session;

/// Carries a request out. The answer is sent when the robot replies, from whatever thread; on the network thread it is
/// turned into a message. Nothing is sent when the session has ended meanwhile.
void handle(const std::shared_ptr<Session>& session, const seeker::v1::Request& request, RobotTime received);

}  // namespace seeker::server_net
