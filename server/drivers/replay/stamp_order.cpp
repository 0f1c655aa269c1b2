#include "server/drivers/replay/stamp_order.hpp"

#include <algorithm>
#include <cmath>

namespace seeker::drivers {
namespace {

/// A stamp farther ahead of the last one than this is damage, or a clock that was set, not a pause.
constexpr double kLongestPause_s = 6.0 * 3600.0;

/// Records that are stamped while in transit may swap places within this time; a larger step is another time.
constexpr double kDisorder_s = 2.0;

/// No clock says so much; beyond it sums of stamps lose their digits.
constexpr double kMostStamp_s = 1e11;

/// So many records must follow on a new time before the clock is taken to have been set to it.
constexpr std::ptrdiff_t kAgreeing = 3;

/// Where a record comes after others at the very same time, or where equal stamps set apart have run ahead.
constexpr double kCrowded = 0.1;

/// How many of the stamps are so.
template <class Is>
std::ptrdiff_t count(std::span<const double> stamps_s, Is is) {
  return std::count_if(stamps_s.begin(), stamps_s.end(), is);
}

bool is_most(std::ptrdiff_t count, std::span<const double> stamps_s) {
  return 2 * count > static_cast<std::ptrdiff_t>(stamps_s.size());
}

/// True where most of what follows is long before this stamp.
bool is_ahead_of_most(double stamp_s, std::span<const double> following_s) {
  return is_most(count(following_s, [&](double next_s) { return next_s < stamp_s - kDisorder_s; }), following_s);
}

/// True where most of what follows is hours after this stamp.
bool is_behind_most(double stamp_s, std::span<const double> following_s) {
  return is_most(count(following_s, [&](double next_s) { return next_s > stamp_s + kLongestPause_s; }), following_s);
}

tl::unexpected<Error> out_of_order() { return fail(Errc::kParse, "its stamp is out of order"); }

}  // namespace

Result<double> StampOrder::place(double stamp_s, std::span<const double> following_s, double& offset_s) {
  if (std::abs(stamp_s) > kMostStamp_s) {
    return out_of_order();
  }
  if (!last_s_) {
    if (is_ahead_of_most(stamp_s, following_s) || is_behind_most(stamp_s, following_s)) {
      return out_of_order();
    }
    last_logged_s_ = stamp_s + offset_s;
    last_s_ = last_logged_s_;
    return *last_s_;
  }
  const double ahead_s = stamp_s + offset_s - *last_logged_s_;
  if (ahead_s > kDisorder_s && is_ahead_of_most(stamp_s, following_s)) {
    return out_of_order();
  }
  if (ahead_s < -kDisorder_s || ahead_s > kLongestPause_s) {
    if (!is_clock_set(following_s, offset_s, ahead_s)) {
      return out_of_order();
    }
    offset_s += *last_s_ + period_s_ - (stamp_s + offset_s);
  } else if (ahead_s < 0.0) {
    return out_of_order();
  }
  const double logged_s = stamp_s + offset_s;
  const bool repeated = logged_s == *last_logged_s_;
  last_s_ = logged_s > *last_s_ ? logged_s : *last_s_ + (repeated ? 1.0 : kCrowded) * period_s_;
  last_logged_s_ = logged_s;
  return *last_s_;
}

bool StampOrder::is_clock_set(std::span<const double> following_s, double offset_s, double ahead_s) const {
  const std::ptrdiff_t with_it = count(following_s, [&](double next_s) {
    const double next_ahead_s = next_s + offset_s - *last_logged_s_;
    return ahead_s < 0.0 ? next_ahead_s < -kDisorder_s : next_ahead_s > kLongestPause_s;
  });
  return with_it >= kAgreeing && is_most(with_it, following_s);
}

}  // namespace seeker::drivers
