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
  std::optional<pki::BundleFiles> tls;                     ///< nothing: plain TCP
  std::uint32_t robot = 0;                                 ///< index of the robot in the world, from 0
  Duration connect_timeout = std::chrono::seconds(5);      ///< wall time for the first connection
  Duration call_timeout = std::chrono::seconds(10);        ///< wall time limit for a reply, except for advance()
  Duration retry_period = std::chrono::milliseconds(200);  ///< wall time between attempts, doubled up to ...
  Duration max_retry_period = std::chrono::seconds(2);     ///< ... this
};

/// A connection used from the loop's thread, which also does the network work while it waits for a reply: there is no
/// other thread. await() connects a broken link again; the world continues without the robot meanwhile.
class EmulatorLink {
 public:
  /// Connects. Errors: kLinkLost or kTimeout where there is no reply, the emulator's own errors, kUnsupportedVersion,
  /// kCorrupt.
  [[nodiscard]] static Result<std::shared_ptr<EmulatorLink>> connect(EmulatorParams params);
  ~EmulatorLink();
  EmulatorLink(const EmulatorLink&) = delete;
  EmulatorLink& operator=(const EmulatorLink&) = delete;

  /// Sends a request and waits for its reply; refusals of the emulator are errors.
  [[nodiscard]] Result<v1::EmulatorReply> call(v1::EmulatorRequest request);
  /// Reports that the tick is finished; await() returns when the next one may begin.
  void advance(Duration period);
  /// Waits at most `limit` of wall time for the world. False: it has not advanced yet, or the link is down and is being
  /// connected again. kCancelled: the emulator was restarted and this robot's world is gone.
  [[nodiscard]] Result<bool> await(Duration limit);

  /// Why the world cannot be reached now. kCancelled: it will never return.
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
  /// Does network work until `done` returns true or `limit` of wall time has passed; returns the last result of done().
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
  std::optional<Error> ended_;  ///< set when the robot's world no longer exists
  std::deque<wire::OutFrame> outgoing_;
  std::uint64_t last_id_ = 0;
  std::optional<v1::EmulatorReply> answer_;  ///< reply to last_call_
  std::uint64_t last_call_ = 0;
  std::uint64_t advance_id_ = 0;  ///< 0: no advance is in progress
  std::optional<std::uint64_t> world_id_;
  RobotTime now_;
  bool lockstep_ = true;
  double speed_ = 0.0;
  StereoGeometry stereo_;
};

}  // namespace seeker::drivers
