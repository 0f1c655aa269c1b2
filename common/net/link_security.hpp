/// \file
/// How a port is protected: TLS with certificates of one site, or plain TCP where that is allowed.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

#include "common/core/result.hpp"
#include "common/core/time.hpp"
#include "common/pki/bundle.hpp"

namespace seeker::net {

/// Bounds on those who have not shown a certificate yet. Times are wall time.
struct HandshakeLimits {
  Duration timeout = std::chrono::seconds(5);  ///< from connection to the end of the handshake
  /// At the same time; one more ends that which has waited longest.
  std::size_t in_progress = 64;
  Duration linger = std::chrono::seconds(1);  ///< for the reason of a refusal to arrive
};

/// When an address is shut out for a while. Times are wall time.
struct LockoutParams {
  std::size_t failures = 10;                     ///< failed handshakes of one address ...
  Duration within = std::chrono::seconds(60);    ///< ... in so much time
  Duration duration = std::chrono::seconds(60);  ///< no connection of it is accepted for so long
  bool loopback = true;                          ///< false: addresses of this machine are never shut out
  std::size_t addresses = 1024;                  ///< that are remembered; the longest silent one is forgotten first
};

struct LinkSecurity {
  pki::BundleFiles files;  ///< no certificate named: plain TCP
  bool insecure = false;   ///< plain TCP is allowed on every address
  HandshakeLimits handshake;
  LockoutParams lockout;
  Duration check_period = std::chrono::seconds(1);  ///< wall time between looks whether a file has changed

  [[nodiscard]] bool tls() const { return !files.certificate.empty(); }
};

/// Whether a port of `address` may be opened so: with TLS, on loopback, or where `insecure` says so. kRefused names the
/// remedy.
[[nodiscard]] Status check_allowed(const std::string& address, const LinkSecurity& security);

}  // namespace seeker::net
