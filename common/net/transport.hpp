/// \file
/// The byte stream under a connection: plain TCP, or TLS over it.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>

#include "common/pki/certificate.hpp"
#include "common/wire/liveness.hpp"

namespace seeker::net {

struct TlsStream;

/// A connected stream. What reads and writes it asks with_stream() (tls_stream.hpp), so that plain TCP pays nothing.
class Transport {
 public:
  using Socket = boost::asio::ip::tcp::socket;

  explicit Transport(Socket socket);
  /// After a handshake; `peer` is the certificate that the other side has shown.
  Transport(std::unique_ptr<TlsStream> tls, pki::Certificate peer);
  Transport(Transport&& other) noexcept;
  Transport& operator=(Transport&& other) noexcept;
  ~Transport();

  /// The TCP connection itself, under TLS too.
  [[nodiscard]] Socket& socket();
  /// Null: plain TCP.
  [[nodiscard]] TlsStream* tls() { return tls_.get(); }
  /// Who is on the other side; null: plain TCP, anybody.
  [[nodiscard]] const std::shared_ptr<const pki::Certificate>& peer() const { return peer_; }
  [[nodiscard]] Socket::executor_type get_executor();
  /// Gives the socket of plain TCP away; the transport cannot be used afterwards.
  [[nodiscard]] Socket take_socket();

 private:
  std::optional<Socket> plain_;
  std::unique_ptr<TlsStream> tls_;
  std::shared_ptr<const pki::Certificate> peer_;
};

/// Address and port of the other side, "10.0.0.7:51234" or "[::1]:51234"; empty: it is gone.
[[nodiscard]] std::string peer_address(Transport& transport);

/// Reads the wall clock for the network threads; all code that they call takes the time as an argument.
[[nodiscard]] inline wire::WallTime wall_now() { return std::chrono::steady_clock::now(); }
/// The calendar clock for what people read, and for comparing it with that of another machine: since 1970, UTC.
[[nodiscard]] inline std::int64_t unix_ns_now() {
  return std::chrono::duration_cast<Duration>(std::chrono::system_clock::now().time_since_epoch()).count();
}

}  // namespace seeker::net
