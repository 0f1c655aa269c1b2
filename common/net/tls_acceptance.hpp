/// \file
/// A connection of which nobody knows yet whose it is.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>

#include <boost/asio/ip/address.hpp>
#include <boost/asio/steady_timer.hpp>

#include "common/core/result.hpp"
#include "common/net/link_security.hpp"
#include "common/net/tls_context.hpp"
#include "common/net/transport.hpp"

namespace seeker::net {

/// The server's side of one handshake. It reads and throws away what a refused client has sent already, for a short
/// time: closing with unread bytes would reset the connection, and the client would never see why it was refused.
class TlsAcceptance : public std::enable_shared_from_this<TlsAcceptance> {
 public:
  struct Handlers {
    /// Called once, unless close() was called before.
    std::function<void(Result<Transport>)> on_result;
    /// Called last, once, unless close() was called before.
    std::function<void(const std::shared_ptr<TlsAcceptance>&)> on_gone;
  };

  TlsAcceptance(Transport::Socket socket, const TlsContext& context, HandshakeLimits limits);
  TlsAcceptance(const TlsAcceptance&) = delete;
  TlsAcceptance& operator=(const TlsAcceptance&) = delete;
  ~TlsAcceptance();

  void start(Handlers handlers);
  /// Closes the connection; no handler is called afterwards.
  void close();
  [[nodiscard]] const boost::asio::ip::address& address() const { return address_; }
  /// True: it was refused, and only the reason is still to be sent.
  [[nodiscard]] bool refused() const { return refused_; }

 private:
  void on_handshake(const boost::system::error_code& error);
  [[nodiscard]] Result<Transport> identify();
  void refuse(const Error& why);
  /// OpenSSL is silent towards who does not speak TLS; by this alert a client of plain TCP knows the reason.
  void send_alert();
  void discard();
  void end();

  std::unique_ptr<TlsStream> tls_;
  HandshakeLimits limits_;
  boost::asio::ip::address address_;
  boost::asio::steady_timer timer_;
  Handlers handlers_;
  std::array<char, 1024> unread_{};
  bool refused_ = false;
};

}  // namespace seeker::net
