/// \file
/// Connecting to an address, once or repeatedly until it succeeds.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "common/core/result.hpp"
#include "common/net/transport.hpp"
#include "common/pki/bundle.hpp"

namespace seeker::net {

/// Whom to connect to, and how.
struct Target {
  std::string host;  ///< name or IP address; with TLS the other side's certificate must name it
  std::uint16_t port = 0;
  Duration timeout = std::chrono::seconds(3);  ///< wall time for look-up, connection and handshake together
  std::optional<pki::BundleFiles> tls;         ///< read for each connection; nothing: plain TCP
};

/// Looks the host up, tries its addresses in turn and, with TLS, shakes hands; `done` is called exactly once, on the
/// io_context. kLinkLost names the cause, kTimeout the time; kRefused: the other side is not whom it should be, or does
/// not speak TLS; the errors of our certificates' files. Whether the other side believes our certificate shows only
/// when something is read from it. The returned function, which may be called at any later time on the io_context,
/// gives up: `done` gets kCancelled, unless it was called before. A handshake that has begun goes on to its end, since
/// the other side would count a broken one as an attack.
std::function<void()> async_connect(boost::asio::io_context& io, Target target,
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
  /// The delay before the first attempt after a connection that was good for `lasted`: what it has not lasted of the
  /// first delay, so that one which breaks again and again is not made more often than without. Does as reset().
  [[nodiscard]] Duration after(Duration lasted) {
    reset();
    return std::max(Duration::zero(), first_ - lasted);
  }

 private:
  Duration first_;
  Duration max_;
  Duration next_;
};

}  // namespace seeker::net
