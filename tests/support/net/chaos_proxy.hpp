/// \file
/// A TCP proxy that misbehaves on request: between a client and a server under test.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace seeker::testing {

/// Listens on a free port of 127.0.0.1 and passes bytes both ways, on its own thread. Methods may be called from any.
class ChaosProxy {
 public:
  explicit ChaosProxy(std::uint16_t server_port);
  ChaosProxy(const ChaosProxy&) = delete;
  ChaosProxy& operator=(const ChaosProxy&) = delete;
  ~ChaosProxy();

  [[nodiscard]] std::uint16_t port() const;
  /// Breaks all connections now; new ones are served.
  void cut();
  /// Breaks the connection when so many more bytes of the client have passed, then again after the next number of the
  /// list, and so on.
  void cut_after(std::vector<std::size_t> bytes);
  /// Cuts of the list that are still to come.
  [[nodiscard]] std::size_t cuts_left() const;
  /// Bytes that clients have sent through.
  [[nodiscard]] std::size_t bytes_from_clients() const;
  /// Passes nothing any more but keeps the connections, until stall(false).
  void stall(bool on);
  /// Refuses new connections (they are accepted and closed).
  void refuse(bool on);
  /// Bytes are passed one read of at most this size at a time; 0: as they come.
  void trickle(std::size_t bytes);
  [[nodiscard]] std::size_t connections() const;

 private:
  class Impl;
  std::shared_ptr<Impl> impl_;
};

}  // namespace seeker::testing
