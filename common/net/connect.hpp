/// \file
/// Connecting to an address, once or repeatedly until it succeeds.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "common/core/result.hpp"
#include "common/net/transport.hpp"

namespace seeker::net {

/// Looks the host up and tries its addresses in turn, within `timeout` of wall time; `done` is called exactly once, on
/// the io_context. kLinkLost names the cause, kTimeout the time.
void async_connect(boost::asio::io_context& io, const std::string& host, std::uint16_t port, Duration timeout,
                   std::function<void(Result<Transport>)> done);

/// Delays between attempts: they double from `first` up to `max`.
class Backoff {
 public:
  Backoff(Duration first, Duration max) : first_(first), max_(max), next_(first) {}
  [[nodiscard]] Duration next() {
    const Duration now = next_;
    next_ = std::min(max_, next_ * 2);
    return now;
  }
  void reset() { next_ = first_; }

 private:
  Duration first_;
  Duration max_;
  Duration next_;
};

}  // namespace seeker::net
