#include "server/nav/wait_turns.hpp"

#include <algorithm>

namespace seeker::nav {
namespace {

/// Who stands so near to where somebody stood before is the same one.
constexpr double kSamePlace_m = 1.0;
/// All waits together, in those of one place: people who walk to and fro are in another place each time.
constexpr int kPlaces = 4;

}  // namespace

WaitTurns::Waited* WaitTurns::known(const Point2& p_map) {
  const auto found = std::find_if(waited_.begin(), waited_.end(),
                                  [&](const Waited& one) { return (one.p_map - p_map).norm() < kSamePlace_m; });
  return found == waited_.end() ? nullptr : &*found;
}

std::optional<WaitTurn> WaitTurns::next(const std::vector<BlockedPlace>& places) {
  if (total_ >= kPlaces * params_.max_waits) {
    return std::nullopt;
  }
  const BlockedPlace* chosen = nullptr;
  int fewest = params_.max_waits;
  for (const BlockedPlace& place : places) {
    const Waited* before = known(place.p_map);
    const int turns = before == nullptr ? 0 : before->turns;
    const bool deserves = place.somebody || turns == 0 || for_nobody_ < params_.max_for_nobody;
    if (deserves && turns < fewest) {
      chosen = &place;
      fewest = turns;
    }
  }
  if (chosen == nullptr) {
    return std::nullopt;
  }
  Waited* waited = known(chosen->p_map);
  ++(waited == nullptr ? waited_.emplace_back(Waited{chosen->p_map, 0}) : *waited).turns;
  ++total_;
  for_nobody_ += chosen->somebody ? 0 : 1;
  return WaitTurn{chosen->p_map, chosen->somebody && (total_ - for_nobody_) % 2 == 0};
}

void WaitTurns::reset() {
  waited_.clear();
  total_ = 0;
  for_nobody_ = 0;
}

void WaitTurns::transform(const MapMove& move) {
  for (Waited& one : waited_) {
    one.p_map = move * one.p_map;
  }
}

}  // namespace seeker::nav
