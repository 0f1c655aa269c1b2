/// \file
/// A TCP proxy that misbehaves on request: between a client and a server under test.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "tests/support/net/impairment.hpp"

namespace seeker::testing {

/// Listens on a free port of 127.0.0.1 and passes bytes both ways, on its own thread. Methods may be called from any.
class ChaosProxy {
 public:
  /// The same seed makes the same draws in the order of what happens.
  explicit ChaosProxy(std::uint16_t server_port, std::uint64_t seed = 1);
  ChaosProxy(const ChaosProxy&) = delete;
  ChaosProxy& operator=(const ChaosProxy&) = delete;
  ~ChaosProxy();

  [[nodiscard]] std::uint16_t port() const;
  /// From now on, for all connections; what is on its way keeps the time it was given. `impair({})` mends.
  void impair(const Impairment& impairment);
  /// Breaks all connections now; new ones are served.
  void cut();
  /// Number of connections that clients have made.
  [[nodiscard]] std::size_t connections() const;
  /// Number of those that are open, half-open ones included.
  [[nodiscard]] std::size_t open() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace seeker::testing
