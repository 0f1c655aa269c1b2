/// \file
/// Calls of which a copy goes over every link to the robot.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "common/rpc/robot_link.hpp"

namespace seeker::rpc {

/// Packets of one connection are delivered in order, so that a lost one holds back all that follow it for two round
/// trips. A copy on another connection is not held back. Used on the thread of the links.
class UrgentCalls {
 public:
  using Answer = wire::ClientSession::Answer;

  /// A request, its copy, and how long an answer may take.
  struct Call {
    seeker::v1::Request request;
    seeker::v1::Request copy;
    Duration timeout{};
  };

  /// Sends the request over `main` and its copy over each of `others` and, until an answer comes, over each that opens.
  /// The first success is delivered, or the robot's answer over `main`; an error of the links only when none is left.
  void call(Call call, const Answer& answer, RobotLink& main, const std::vector<std::shared_ptr<RobotLink>>& others);
  /// Another link than the main one can be used now.
  void opened(RobotLink& link);

 private:
  struct Waiting {
    Call call;
    wire::WallTime deadline;
    Answer answer;
    int open = 0;  ///< requests without an answer
    bool answered = false;
  };

  static void send(const std::shared_ptr<Waiting>& waiting, RobotLink& link, bool main);

  std::vector<std::weak_ptr<Waiting>> calls_;
};

}  // namespace seeker::rpc
