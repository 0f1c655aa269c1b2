/// \file
/// Accepting connections.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>

#include "common/core/result.hpp"
#include "common/net/link_health.hpp"
#include "common/net/link_security.hpp"
#include "common/net/transport.hpp"

namespace seeker::net {

class TlsDoor;

/// Accepts connections until it is closed; with TLS, those that show a certificate. After a connection that could not
/// be accepted (no file descriptor left) it waits a moment and continues. All calls and handlers are made on the
/// io_context's single thread once that runs; the listener outlives what runs there.
class Listener {
 public:
  struct Handlers {
    std::function<void(Transport)> on_transport;
    /// With TLS: called once per `check_period`, after a look whether certificates have changed. Who is connected may
    /// not be believed any more: check() says so then.
    std::function<void()> on_check = [] {};
  };

  /// `part` names the component in log lines about failures; its characters must outlive the listener.
  Listener(boost::asio::io_context& io, std::string_view part, Handlers handlers);
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  ~Listener();

  /// Opens an interface of this machine and returns its port; port 0 takes any free one. The errors name the address
  /// and the cause: kIo, kInvalidArgument, kRefused where plain TCP is not allowed there, those of the certificates.
  [[nodiscard]] Result<std::uint16_t> open(const std::string& address, std::uint16_t port,
                                           const LinkSecurity& security = {});
  /// Starts to accept connections, those that have arrived since open() included.
  void accept();
  void close();

  /// For Handlers::on_check: whether who has connected with this certificate is still to be believed; null (plain TCP)
  /// always is.
  [[nodiscard]] Status check(const pki::Certificate* peer) const;
  [[nodiscard]] LinkHealth health() const;

 private:
  void receive(Transport::Socket socket);

  boost::asio::io_context& io_;
  std::string_view part_;
  Handlers handlers_;
  boost::asio::ip::tcp::acceptor acceptor_;
  boost::asio::steady_timer pause_;
  std::unique_ptr<TlsDoor> door_;  ///< null: plain TCP
  LinkHealth health_;
  bool renewed_ = false;  ///< since the last look
  bool closed_ = false;
};

}  // namespace seeker::net
