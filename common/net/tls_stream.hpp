/// \file
/// TLS over a socket. Included in .cpp files only: it costs time to compile.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/stream.hpp>

#include "common/net/gathering_socket.hpp"
#include "common/net/transport.hpp"

namespace seeker::net {

struct TlsStream {
  /// Takes over the session.
  TlsStream(boost::asio::ip::tcp::socket socket, SSL* session) : stream(std::move(socket), session) {}

  boost::asio::ssl::stream<GatheringSocket> stream;
};

/// Calls `go` with the stream that carries the bytes of a transport.
template <class Go>
void with_stream(Transport& transport, Go&& go) {
  if (TlsStream* tls = transport.tls()) {
    go(tls->stream);
  } else {
    go(transport.socket());
  }
}

}  // namespace seeker::net
