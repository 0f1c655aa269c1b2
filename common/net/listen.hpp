/// \file
/// Accepting connections.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>

#include "common/core/result.hpp"

namespace seeker::net {

/// Accepts connections until it is closed. After a connection that could not be accepted (no file descriptor left) it
/// waits a moment and continues. All calls, and `on_socket`, are made on the io_context's single thread once that runs;
/// the listener outlives what runs there.
class Listener {
 public:
  /// `part` names the component in log lines about failures; its characters must outlive the listener.
  Listener(boost::asio::io_context& io, std::string_view part,
           std::function<void(boost::asio::ip::tcp::socket)> on_socket);

  /// Opens an interface of this machine and returns its port; port 0 takes any free one. The errors kIo and
  /// kInvalidArgument name the address and the cause.
  [[nodiscard]] Result<std::uint16_t> open(const std::string& address, std::uint16_t port);
  /// Starts to accept connections, those that have arrived since open() included.
  void accept();
  void close();

 private:
  std::string_view part_;
  std::function<void(boost::asio::ip::tcp::socket)> on_socket_;
  boost::asio::ip::tcp::acceptor acceptor_;
  boost::asio::steady_timer pause_;
  bool closed_ = false;
};

}  // namespace seeker::net
