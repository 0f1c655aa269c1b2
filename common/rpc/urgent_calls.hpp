/// \file
/// Calls of which a copy goes over every link to the robot.
#pragma once

#include <memory>
#include <vector>

#include "common/rpc/robot_link.hpp"

namespace seeker::rpc {

/// Packets of one connection are delivered in order, so that a lost one holds back all that follow it for two round
/// trips. A copy on another connection is not held back. The robot carries a request with `once` out one time, however
/// many copies arrive. Used on the thread of the links.
class UrgentCalls {
 public:
  /// Sends a copy over each of `links` and, until an answer comes, over each that opens. The first answer of the robot
  /// is delivered; an error of the links only when no copy is left.
  void call(const seeker::v1::Request& request, Duration timeout, const wire::ClientSession::Answer& answer,
            const std::vector<RobotLink*>& links);
  /// A link can be used now.
  void opened(RobotLink& link);

 private:
  struct Call {
    seeker::v1::Request request;
    Duration timeout{};
    wire::ClientSession::Answer answer;
    int copies = 0;  ///< without an answer
    bool answered = false;
  };

  static void send_copy(const std::shared_ptr<Call>& call, RobotLink& link);

  std::vector<std::weak_ptr<Call>> calls_;
};

}  // namespace seeker::rpc
