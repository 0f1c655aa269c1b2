/// \file
/// The stamps of one kind of records (odometry, or scans) made to rise, as a recorder's clock seldom does all the time.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "common/core/result.hpp"

namespace seeker::drivers {

/// Judges stamp after stamp, knowing those that follow: what a single wrong stamp says is not believed, and a clock
/// that was set while it recorded costs no record.
class StampOrder {
 public:
  /// Stamps by which a record's place in time is judged.
  static constexpr std::size_t kLookAhead = 16;

  /// Records that share a stamp (a clock that counts seconds) are set `period_s` apart.
  explicit StampOrder(double period_s) : period_s_(period_s) {}

  /// When the record stamped `stamp_s` was made, on a clock that only rises; kParse with the reason where its stamp
  /// cannot be right. `following_s`: stamps of the next records of this kind, up to kLookAhead. `offset_s`: what is to
  /// be added to the log's clock; changed where the clock was set.
  [[nodiscard]] Result<double> place(double stamp_s, std::span<const double> following_s, double& offset_s);

 private:
  /// True where what follows stands on the same side of the step of `ahead_s` as the record does.
  [[nodiscard]] bool is_clock_set(std::span<const double> following_s, double offset_s, double ahead_s) const;

  double period_s_;
  std::optional<double> last_logged_s_;  ///< with the offset, before equal stamps were set apart
  std::optional<double> last_s_;
};

}  // namespace seeker::drivers
