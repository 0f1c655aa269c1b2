/// \file
/// A robot's connection to the world that seeker-emulator hosts.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include <boost/asio/io_context.hpp>

#include "common/core/result.hpp"
#include "common/core/stereo.hpp"
#include "common/core/time.hpp"
#include "common/net/connect.hpp"
#include "common/net/connection.hpp"
#include "seeker/v1/emulator.pb.h"

namespace seeker::drivers {

struct EmulatorParams {
  std::string host = "127.0.0.1";
  std::uint16_t port = 7472;
  std::uint32_t robot = 0;                                 ///< which robot of the world, from 0
  Duration connect_timeout = std::chrono::seconds(5);      ///< wall time for the first connection
  Duration call_timeout = std::chrono::seconds(10);        ///< wall time for an answer, advance() apart
  Duration retry_period = std::chrono::milliseconds(200);  ///< wall time between attempts, doubled up to ...
  Duration max_retry_period = std::chrono::seconds(2);     ///< ... this
};

/// Calls come from the loop's thread, which also does the network work while it waits for an answer: there is no thread
/// behind it. A broken link is made anew by await(); the world goes on without the robot meanwhile.
class EmulatorLink {
 public:
  /// Errors: kLinkLost or kTimeout where nobody answers, what the emulator says, kUnsupportedVersion, kCorrupt.
  [[nodiscard]] static Result<std::shared_ptr<EmulatorLink>> connect(EmulatorParams params);
  ~EmulatorLink();
  EmulatorLink(const EmulatorLink&) = delete;
  EmulatorLink& operator=(const EmulatorLink&) = delete;

  /// Sends a request and waits for its reply; the emulator's own refusals are errors.
  [[nodiscard]] Result<v1::EmulatorReply> call(v1::EmulatorRequest request);
  /// Says that the tick is finished; await() tells when the next one may begin.
  void advance(Duration period);
  /// Waits at most `limit` of wall time for the world. False: not there yet, or the link is down and is being made
  /// anew. kCancelled: another run of the emulator has taken the place of the one this robot was in.
  [[nodiscard]] Result<bool> await(Duration limit);

  /// Why the world cannot be reached now. kCancelled: it never comes back.
  [[nodiscard]] Status reachable() const;
  [[nodiscard]] RobotTime now() const { return now_; }
  [[nodiscard]] bool lockstep() const { return lockstep_; }
  [[nodiscard]] double speed() const { return speed_; }
  [[nodiscard]] const StereoGeometry& stereo() const { return stereo_; }

 private:
  enum class State { kDown, kConnecting, kGreeting, kUp };

  explicit EmulatorLink(EmulatorParams params);
  void try_connect();
  void greet(net::Transport transport);
  void on_frame(std::string_view payload);
  void on_reply(v1::EmulatorReply reply);
  [[nodiscard]] Status take_welcome(const v1::EmulatorReply& reply);
  void send(v1::EmulatorRequest& request);
  void lose(const Error& error);
  /// Does network work until `done`, or `limit` of wall time has passed; what done() said last.
  template <class Done>
  bool work_until(Done done, Duration limit);

  EmulatorParams params_;
  std::uint64_t instance_;
  boost::asio::io_context io_{1};
  net::Backoff backoff_;
  std::shared_ptr<net::Connection> connection_;
  State state_ = State::kDown;
  wire::WallTime next_try_{};
  Error why_down_{Errc::kLinkLost, "not connected"};
  std::optional<Error> ended_;  ///< the world is not the same any more
  std::deque<wire::OutFrame> outgoing_;
  std::uint64_t last_id_ = 0;
  std::optional<v1::EmulatorReply> answer_;  ///< to last_call_
  std::uint64_t last_call_ = 0;
  std::uint64_t advance_id_ = 0;  ///< 0: none under way
  std::optional<std::uint64_t> world_id_;
  RobotTime now_;
  bool lockstep_ = true;
  double speed_ = 0.0;
  StereoGeometry stereo_;
};

}  // namespace seeker::drivers
