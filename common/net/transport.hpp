/// \file
/// The byte stream under a connection. Plain TCP here; TLS comes in at this one place: Transport becomes a class that
/// holds either the socket or an ssl::stream over it, with the same three operations that Connection uses
/// (async_read_some, async_write of a buffer sequence, close), and accept/connect add the handshake before they hand
/// it over.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>

#include "common/wire/liveness.hpp"

namespace seeker::net {

using Transport = boost::asio::ip::tcp::socket;

/// The one reading of the wall clock that the network threads make; everything below takes it as an argument.
[[nodiscard]] inline wire::WallTime wall_now() { return std::chrono::steady_clock::now(); }

}  // namespace seeker::net
