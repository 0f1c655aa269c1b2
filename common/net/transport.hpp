/// \file
/// The byte stream under a connection: plain TCP. TLS would be added here alone: Transport would be a class that holds
/// either the socket or an ssl::stream over it, with the three operations that Connection uses (async_read_some,
/// async_write of a buffer sequence, close), and accept and connect would add the handshake.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>

#include "common/wire/liveness.hpp"

namespace seeker::net {

using Transport = boost::asio::ip::tcp::socket;

/// Reads the wall clock for the network threads; all code that they call takes the time as an argument.
[[nodiscard]] inline wire::WallTime wall_now() { return std::chrono::steady_clock::now(); }

}  // namespace seeker::net
