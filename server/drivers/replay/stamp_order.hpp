/// \file
/// Correction of the stamps of one kind of records (odometry or scans) so that they rise, because a recorder's clock
/// often does not.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "common/core/result.hpp"

namespace seeker::drivers {

/// Judges one stamp after another with the help of those that follow: a single wrong stamp is rejected, and a clock
/// that was set during the recording costs no record.
class StampOrder {
 public:
  /// Number of following stamps by which a record's place in time is judged.
  static constexpr std::size_t kLookAhead = 16;

  /// Records that share a stamp (of a clock that counts seconds) are placed `period_s` apart.
  explicit StampOrder(double period_s) : period_s_(period_s) {}

  /// When the record stamped `stamp_s` was made, on a clock that only rises; kParse with the cause where its stamp
  /// cannot be right. `following_s`: stamps of the next records of this kind, up to kLookAhead. `offset_s`: offset
  /// added to the log's clock, changed where the clock was set.
  [[nodiscard]] Result<double> place(double stamp_s, std::span<const double> following_s, double& offset_s);

 private:
  /// Whether the following stamps lie on the same side of the step of `ahead_s` as the record does.
  [[nodiscard]] bool is_clock_set(std::span<const double> following_s, double offset_s, double ahead_s) const;

  double period_s_;
  std::optional<double> last_logged_s_;  ///< with the offset, before equal stamps were placed apart
  std::optional<double> last_s_;
};

}  // namespace seeker::drivers
