/// \file
/// The context of a verb: the robot, the output streams, the limits. Verbs are functions of it, so that tests run them
/// against a robot in memory.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>

#include "client/cli/exit_code.hpp"
#include "common/api/robot_api.hpp"

namespace seeker::cli {

inline constexpr Duration kDefaultAnswerTime = std::chrono::seconds(5);
/// Period at which a waiting verb checks for Ctrl-C and for the state of the link.
inline constexpr Duration kPollPeriod = std::chrono::milliseconds(50);

struct Context {
  std::shared_ptr<api::RobotApi> robot;
  std::ostream* out = nullptr;  ///< receives data
  std::ostream* err = nullptr;  ///< receives messages and progress
  bool json = false;
  bool quiet = false;
  bool verbose = false;
  bool out_is_tty = false;
  bool err_is_tty = false;
  bool colour = false;
  std::string tls;                     ///< as given with --tls
  std::optional<Duration> timeout;     ///< wall time, as given with --timeout
  std::string client_name = "seeker";  ///< name given to the robot, by which it names the owner of a lease
  /// Whether SIGINT has arrived.
  std::function<bool()> interrupted = [] { return false; };
  /// The reason when the link is lost for good; std::nullopt while it works or is being restored.
  std::function<std::optional<Error>()> link_error = [] { return std::optional<Error>(); };

  [[nodiscard]] Duration answer_time() const { return timeout.value_or(kDefaultAnswerTime); }
};

/// Writes one line to stderr unless --quiet.
void say(const Context& context, std::string_view text);

/// Sleeps for a duration of wall time; false when interrupted before its end.
[[nodiscard]] bool sleep_for(const Context& context, Duration duration);

/// The reason why a wait must end early: kCancelled (Ctrl-C) or kLinkLost; std::nullopt: none.
[[nodiscard]] std::optional<Error> broken(const Context& context);

/// Makes a call and waits for the answer. Errors: the robot's, kTimeout, kCancelled (Ctrl-C), kLinkLost.
template <class T>
[[nodiscard]] Result<T> ask(const Context& context, const std::function<void(api::Reply<T>)>& call) {
  auto promise = std::make_shared<std::promise<Result<T>>>();
  std::future<Result<T>> future = promise->get_future();
  call([promise](Result<T> result) { promise->set_value(std::move(result)); });
  const auto end = std::chrono::steady_clock::now() + context.answer_time();
  while (future.wait_for(kPollPeriod) != std::future_status::ready) {
    if (const std::optional<Error> error = broken(context)) {
      return tl::unexpected<Error>(*error);
    }
    if (std::chrono::steady_clock::now() >= end) {
      return fail(Errc::kTimeout, "no answer from the robot in time; check that it runs, or allow more with --timeout");
    }
  }
  return future.get();
}

/// Calls a method of RobotApi whose only parameter is the reply.
template <class T>
[[nodiscard]] Result<T> ask(const Context& context, void (api::RobotApi::*method)(api::Reply<T>)) {
  return ask<T>(context, [&](api::Reply<T> reply) { (context.robot.get()->*method)(std::move(reply)); });
}

}  // namespace seeker::cli
