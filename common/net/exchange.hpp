/// \file
/// One request and one reply at a time, with a wait between them: for programs that make one call after the other.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include <boost/asio/io_context.hpp>

#include "common/core/result.hpp"
#include "common/net/connect.hpp"
#include "common/net/connection.hpp"

namespace seeker::net {

/// Calls come from one thread, which does the network work while it waits.
class Exchange {
 public:
  /// Connects to a server. Errors of async_connect().
  [[nodiscard]] static Result<std::unique_ptr<Exchange>> connect(Target target);
  Exchange(const Exchange&) = delete;
  Exchange& operator=(const Exchange&) = delete;
  ~Exchange();

  /// Sends a request and returns the payload of the reply. Errors: kLinkLost, kTimeout, kTooLarge, kRefused; the
  /// connection cannot be used after one.
  [[nodiscard]] Result<std::string> ask(std::string payload, Duration timeout);

 private:
  Exchange() = default;
  void start(Transport transport);

  boost::asio::io_context io_{1};
  std::shared_ptr<Connection> connection_;
  std::optional<wire::OutFrame> request_;
  std::optional<std::string> reply_;
  std::optional<Error> broken_;
};

}  // namespace seeker::net
