/// \file
/// An estimator with a map whose every word the test writes.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "server/slam/map_tracker.hpp"

namespace seeker::testing {

/// What the tracker holds; shared with the test, which changes it between ticks, or under the mutex where a loop runs.
struct FakeMapState {
  std::mutex mutex;
  LineMap map;
  std::vector<slam::MapPiece> pieces;
  std::uint64_t revision = 0;
  PoseEstimate estimate;
  slam::MapUse use = slam::MapUse::kContinue;
  int loads = 0;
  int scans = 0;
  /// After a relocalisation the pose is unknown for so many scans; then it is found, or lost when there is a cause.
  int scans_to_search = 3;
  std::string lost_because;
  Pose2 found_at;
  std::optional<int> searching;  ///< scans left

  void changed() { ++revision; }
};

class FakeMapTracker final : public slam::MapTracker {
 public:
  explicit FakeMapTracker(std::shared_ptr<FakeMapState> state) : state_(std::move(state)) {
    state_->estimate.quality = LocalisationQuality::kLocalised;
  }

  [[nodiscard]] Status predict(const Pose2& odom_T_base, RobotTime stamp) override {
    const std::lock_guard lock(state_->mutex);
    // Odometry of the fake robot is perfect: the increment moves the pose.
    if (odom_T_base_) {
      state_->estimate.map_T_base = state_->estimate.map_T_base * (inverse(*odom_T_base_) * odom_T_base);
    }
    odom_T_base_ = odom_T_base;
    state_->estimate.stamp = stamp;
    return {};
  }
  [[nodiscard]] Status update(const LaserScan& /*scan*/) override {
    const std::lock_guard lock(state_->mutex);
    ++state_->scans;
    if (state_->searching && --*state_->searching <= 0) {
      state_->searching.reset();
      const bool found = state_->lost_because.empty();
      state_->estimate.quality = found ? LocalisationQuality::kLocalised : LocalisationQuality::kLost;
      state_->estimate.cause = state_->lost_because;
      if (found) {
        state_->estimate.map_T_base = state_->found_at;
      }
    }
    return {};
  }
  [[nodiscard]] PoseEstimate estimate() const override {
    const std::lock_guard lock(state_->mutex);
    return state_->estimate;
  }
  void reset(const Pose2& map_T_base) override {
    const std::lock_guard lock(state_->mutex);
    state_->map = {};
    state_->changed();
    state_->searching.reset();
    state_->estimate.map_T_base = map_T_base;
    state_->estimate.quality = LocalisationQuality::kLocalised;
    state_->estimate.cause.clear();
  }

  [[nodiscard]] std::vector<slam::MapPiece> pieces() const override {
    const std::lock_guard lock(state_->mutex);
    return state_->pieces;
  }
  [[nodiscard]] std::vector<MapSegment> segments() const override {
    const std::lock_guard lock(state_->mutex);
    return state_->map.segments;
  }
  [[nodiscard]] std::uint64_t revision() const override {
    const std::lock_guard lock(state_->mutex);
    return state_->revision;
  }
  [[nodiscard]] LineMap map() const override {
    const std::lock_guard lock(state_->mutex);
    return state_->map;
  }
  [[nodiscard]] Status load(const LineMap& map, slam::MapUse use) override {
    const std::lock_guard lock(state_->mutex);
    if (Status ok = validate(map); !ok) {
      return ok;
    }
    state_->map = map;
    state_->use = use;
    ++state_->loads;
    state_->changed();
    state_->estimate.map_epoch = map.epoch;
    search();
    return {};
  }
  [[nodiscard]] Status look_where_it_stood(const Pose2& map_T_base) override { return relocalise(map_T_base); }
  [[nodiscard]] Status relocalise(const std::optional<Pose2>& map_T_base) override {
    const std::lock_guard lock(state_->mutex);
    if (state_->map.segments.empty()) {
      return fail(Errc::kNotReady, "there is no map to look in; load or build one");
    }
    state_->found_at = map_T_base.value_or(state_->found_at);
    search();
    return {};
  }
  void for_each_scan(const std::function<void(const LaserScan&, const Pose2&)>& visit) const override {
    const std::lock_guard lock(state_->mutex);
    for (const MapKeyframe& keyframe : state_->map.keyframes) {
      for (const MapNode& node : state_->map.nodes) {
        if (node.id == keyframe.node) {
          visit(unpack_scan(keyframe), node.map_T_node * keyframe.node_T_base);
        }
      }
    }
  }

 private:
  void search() {
    state_->searching = state_->scans_to_search;
    state_->estimate.quality = LocalisationQuality::kUnknown;
    state_->estimate.cause = "looking for the place in the map";
  }

  std::shared_ptr<FakeMapState> state_;
  std::optional<Pose2> odom_T_base_;
};

}  // namespace seeker::testing
