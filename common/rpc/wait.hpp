/// \file
/// Calls that wait for their reply, for programs that make one call after the other.
#pragma once

#include <functional>
#include <future>
#include <memory>

#include "common/api/robot_api.hpp"

namespace seeker::rpc {

/// Makes the call and waits for its reply; kTimeout when none came in time (a late reply is ignored).
/// Never use it on the thread that delivers replies. Example:
///   auto status = wait<api::RobotStatus>([&](auto reply) { robot->get_status(std::move(reply)); }, 2s);
template <class T>
[[nodiscard]] Result<T> wait(const std::function<void(api::Reply<T>)>& call, Duration timeout) {
  auto promise = std::make_shared<std::promise<Result<T>>>();
  std::future<Result<T>> future = promise->get_future();
  call([promise](Result<T> result) { promise->set_value(std::move(result)); });
  if (future.wait_for(timeout) != std::future_status::ready) {
    return fail(Errc::kTimeout, "no answer from the robot in " + std::to_string(to_seconds(timeout)) +
                                    " s; check the link, or allow more time");
  }
  return future.get();
}

}  // namespace seeker::rpc
