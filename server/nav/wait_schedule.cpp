#include "server/nav/wait_schedule.hpp"

#include <algorithm>

namespace seeker::nav {
namespace {

/// Who stands so near to where somebody stood before is the same one.
constexpr double kSamePlace_m = 1.0;
/// All waits together, in those of one place: people who walk to and fro are in another place each time.
constexpr int kPlaces = 4;

}  // namespace

WaitSchedule::Waited* WaitSchedule::known(const Point2& p_map) {
  const auto found = std::find_if(waited_.begin(), waited_.end(),
                                  [&](const Waited& one) { return (one.p_map - p_map).norm() < kSamePlace_m; });
  return found == waited_.end() ? nullptr : &*found;
}

std::optional<PlannedWait> WaitSchedule::next(const std::vector<BlockedPlace>& places) {
  if (total_ >= kPlaces * params_.max_waits) {
    return std::nullopt;
  }
  const BlockedPlace* chosen = nullptr;
  int fewest = params_.max_waits;
  for (const BlockedPlace& place : places) {
    const Waited* before = known(place.p_map);
    const int waits = before == nullptr ? 0 : before->waits;
    const bool deserves = place.somebody || waits == 0 || for_nobody_ < params_.max_for_nobody;
    if (deserves && waits < fewest) {
      chosen = &place;
      fewest = waits;
    }
  }
  if (chosen == nullptr) {
    return std::nullopt;
  }
  Waited* waited = known(chosen->p_map);
  ++(waited == nullptr ? waited_.emplace_back(Waited{chosen->p_map, 0}) : *waited).waits;
  ++total_;
  for_nobody_ += chosen->somebody ? 0 : 1;
  return PlannedWait{chosen->p_map, chosen->somebody && (total_ - for_nobody_) % 2 == 0};
}

void WaitSchedule::reset() {
  waited_.clear();
  total_ = 0;
  for_nobody_ = 0;
}

void WaitSchedule::transform(const MapMove& move) {
  for (Waited& one : waited_) {
    one.p_map = move * one.p_map;
  }
}

}  // namespace seeker::nav
