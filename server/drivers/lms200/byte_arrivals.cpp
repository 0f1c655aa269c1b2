#include "server/drivers/lms200/byte_arrivals.hpp"

#include <algorithm>

#include "common/core/assert.hpp"

namespace seeker::drivers {

void ByteArrivals::note(std::uint64_t first_byte, std::size_t size, RobotTime now) {
  if (size == 0) {
    return;
  }
  SEEKER_ASSERT(pieces_.empty() || first_byte >= pieces_.back().end_byte);
  pieces_.push_back({first_byte + size, now});
  while (pieces_.size() > 1 && pieces_.front().end_byte + kRememberedBytes < pieces_.back().end_byte) {
    pieces_.pop_front();
  }
}

RobotTime ByteArrivals::latest_arrival(std::uint64_t byte) const {
  SEEKER_ASSERT(!pieces_.empty() && byte < pieces_.back().end_byte);
  RobotTime latest = RobotTime::max();
  for (const Piece& piece : pieces_) {
    if (piece.end_byte > byte) {
      const auto behind = static_cast<std::int64_t>(piece.end_byte - 1 - byte);
      latest = std::min(latest, piece.time - behind * byte_time_);
    }
  }
  return latest;
}

}  // namespace seeker::drivers
