/// \file
/// When bytes of a stream came, although they are handed over late and many at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

#include "common/core/time.hpp"

namespace seeker::drivers {

/// Remembers the pieces in which the newest bytes of a stream were handed over. A byte cannot have come after the piece
/// that holds it; nor, on a line that needs b seconds for a byte, after any later byte m less (m - first) b. The
/// earliest of these limits is within the shortest delay of all pieces of a telegram, where the first piece alone would
/// be within its own.
class ByteArrivals {
 public:
  /// `byte_time`: time of one byte on the line; 0 where the line has no rate of its own.
  explicit ByteArrivals(Duration byte_time) : byte_time_(byte_time) {}

  /// `size` bytes were handed over, the first with this index in the stream. Indices only rise.
  void note(std::uint64_t first_byte, std::size_t size, RobotTime now);
  /// The latest time at which this byte can have come. It is one of the newest kRememberedBytes that were noted.
  [[nodiscard]] RobotTime latest_arrival(std::uint64_t byte) const;

  static constexpr std::size_t kRememberedBytes = 2048;

 private:
  struct Piece {
    std::uint64_t end_byte = 0;  ///< index behind its last byte
    RobotTime time;
  };

  Duration byte_time_;
  std::deque<Piece> pieces_;
};

}  // namespace seeker::drivers
