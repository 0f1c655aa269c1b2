/// \file
/// One handler per request: message to value, call the robot, value to message.
#pragma once

#include <memory>

#include "common/core/time.hpp"
#include "seeker/v1/calls.pb.h"

namespace seeker::server_net {

class Session;

/// Carries out a request. The robot may reply on any thread; the response is made and sent on the network thread. No
/// response is sent when the session has ended meanwhile.
void handle(const std::shared_ptr<Session>& session, const seeker::v1::Request& request, RobotTime received);

}  // namespace seeker::server_net
