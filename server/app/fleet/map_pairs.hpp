/// \file
/// The maps of all robots of a fleet and what the merger says of each two of them.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "common/core/line_map.hpp"
#include "server/app/fleet/robot_report.hpp"
#include "server/fleet/fleet_merge.hpp"
#include "server/fleet/map_merger.hpp"

namespace seeker::app {

/// Prepared maps by slot, and an answer of the merger for each pair that was compared. It is for one thread, that of
/// the worker, and has no lock.
class MapPairs {
 public:
  /// `retry_period`: see compare_aged().
  MapPairs(const fleet::MergeParams& params, Duration retry_period) : merger_(params), retry_period_(retry_period) {}

  /// Takes the map of a robot as it is now, and its pictures. Errors as validate(LineMap).
  [[nodiscard]] Status update(std::uint8_t slot, LineMap map, fleet::NodePictures pictures = {});
  /// A robot has begun a new map: its map before and the answers for its pairs are dropped. Nothing that was prepared
  /// of the one may serve the other, however alike their numbers of local maps and keyframes are.
  void forget_map(std::uint8_t slot);
  /// Takes up an answer from before a restart. It is dropped where the map of one of the two robots is not there.
  void recall(fleet::PairAnswer pair, WallTime now);
  /// Marks the answers that speak of local maps which are no more: they count for nothing but the next comparison.
  void mark_stale();
  /// Compares the maps of two robots, the lower slot first, unless neither has changed since. Both must be there.
  void compare(std::uint8_t a, std::uint8_t b);
  /// The same where there is no answer yet, or it is stale or older than the retry period: of many robots some change
  /// all the time.
  void compare_aged(std::uint8_t a, std::uint8_t b, WallTime now);

  [[nodiscard]] bool contains(std::uint8_t slot) const { return prepared_.contains(slot); }
  /// Empty where the robot has none.
  [[nodiscard]] const LineMap& map(std::uint8_t slot) const;
  /// Empty where the robot has none.
  [[nodiscard]] const fleet::NodePictures& pictures(std::uint8_t slot) const;
  /// Rises when the map or the pictures of the robot change; 0: it has none.
  [[nodiscard]] std::uint64_t version(std::uint8_t slot) const;
  /// By rising slots. Without the stale ones:
  [[nodiscard]] std::vector<fleet::PairAnswer> fresh_answers() const;
  /// and with them.
  [[nodiscard]] std::vector<fleet::PairAnswer> all_answers() const;

 private:
  struct Compared {
    fleet::MergeAnswer answer;
    WallTime at;
    std::pair<std::uint64_t, std::uint64_t> versions;  ///< of the maps
    bool stale = false;
  };

  fleet::MapMerger merger_;
  Duration retry_period_;
  std::map<std::uint8_t, fleet::PreparedMap> prepared_;
  std::map<std::uint8_t, std::uint64_t> versions_;
  std::map<std::pair<std::uint8_t, std::uint8_t>, Compared> pairs_;  ///< the lower slot first
};

}  // namespace seeker::app
