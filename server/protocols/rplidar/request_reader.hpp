/// \file
/// Requests out of the bytes that a host sends, as the device reads them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "server/protocols/rplidar/request.hpp"

namespace seeker::rplidar {

/// Reads requests from bytes cut anywhere. What is no request, or one whose check is wrong, is skipped byte by byte, so
/// that no whole request behind it is lost. Holds less than one request.
class RequestReader {
 public:
  /// Takes all bytes and returns the requests that they complete.
  [[nodiscard]] std::vector<Request> read(std::span<const std::uint8_t> bytes);
  /// The rest of a request that has begun does not come any more: returns what can be read without it.
  [[nodiscard]] std::vector<Request> give_up();
  /// Whether a request has begun that is not whole.
  [[nodiscard]] bool waits() const { return !buffer_.empty(); }
  /// Drops everything, as at power on.
  void clear() { buffer_.clear(); }

 private:
  [[nodiscard]] std::vector<Request> take_whole();

  std::vector<std::uint8_t> buffer_;
};

}  // namespace seeker::rplidar
