/// \file
/// Where connections come in.
#pragma once

#include <cstdint>
#include <string>

#include <boost/asio/ip/tcp.hpp>

#include "common/core/result.hpp"

namespace seeker::net {

/// Opens `acceptor` on an interface of this machine; port 0 takes any free one. The answer is the port; kIo and
/// kInvalidArgument name the address and the cause.
[[nodiscard]] Result<std::uint16_t> listen_on(boost::asio::ip::tcp::acceptor& acceptor, const std::string& address,
                                              std::uint16_t port);

}  // namespace seeker::net
