/// \file
/// seeker-emulator on the network: one connection per robot, one thread for everything.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>

#include "common/core/result.hpp"
#include "common/net/listen.hpp"
#include "server/emulator/world_host.hpp"

namespace seeker::emulator {

struct EmulatorServerParams {
  std::string address = "127.0.0.1";
  std::uint16_t port = 7472;                           ///< 0: any free one
  bool lockstep = true;                                ///< as in HostParams
  double speed = 0.0;                                  ///< as in HostParams; above 0 without lockstep
  Duration live_step = std::chrono::milliseconds(20);  ///< robot time between steps without lockstep
  Duration hello_timeout = std::chrono::seconds(3);    ///< wall time from connection to hello
  net::LinkSecurity security = {};
};

class EmulatorServer {
 public:
  /// `host` must outlive this.
  EmulatorServer(WorldHost& host, EmulatorServerParams params);
  ~EmulatorServer();
  EmulatorServer(const EmulatorServer&) = delete;
  EmulatorServer& operator=(const EmulatorServer&) = delete;

  /// Listens for robots and returns the port.
  [[nodiscard]] Result<std::uint16_t> listen();
  /// Serves until stop() is called, from any thread; then closes all connections.
  void run();
  void stop();

  /// Is called after every step of the world.
  std::function<void()> on_step;

 private:
  struct Peer;
  void close_all();
  void admit(net::Transport transport);
  /// Drops those who are not believed any more.
  void check_certificates();
  void on_frame(const std::shared_ptr<Peer>& peer, std::string_view payload);
  void greet(const std::shared_ptr<Peer>& peer, const v1::EmulatorRequest& request);
  void send(const std::shared_ptr<Peer>& peer, const v1::EmulatorReply& reply);
  void drop(const std::shared_ptr<Peer>& peer, const std::string& why);
  /// Schedules the next step of the world, unless one is scheduled or the world has to wait.
  void schedule_step();
  void step(RobotTime to);
  void step_live();
  void pace(Duration period);

  WorldHost& host_;
  EmulatorServerParams params_;
  boost::asio::io_context io_{1};
  net::Listener listener_;
  boost::asio::steady_timer pace_;
  std::set<std::shared_ptr<Peer>> peers_;
  std::map<std::size_t, std::shared_ptr<Peer>> robots_;  ///< those that have said hello
  bool step_scheduled_ = false;                          ///< true: a step is scheduled
  bool stopping_ = false;
};

}  // namespace seeker::emulator
