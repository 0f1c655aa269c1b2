/// \file
/// Random but valid values of every kind that travels, from one seed.
#pragma once

#include "common/api/robot_api.hpp"
#include "common/core/rng.hpp"

namespace seeker::testing {

/// Makes values; the same seed makes the same ones.
class ValueMaker {
 public:
  explicit ValueMaker(std::uint64_t seed) : rng_(seed) {}

  double number() { return rng_.uniform(-1e3, 1e3); }
  bool flag() { return rng_.below(2) == 0; }
  int count(int most) { return static_cast<int>(rng_.below(static_cast<std::uint64_t>(most) + 1)); }
  RobotTime time() { return RobotTime(Duration(static_cast<std::int64_t>(rng_.below(1ULL << 60U)))); }
  Pose2 pose() { return {number(), number(), number()}; }
  Point2 point() { return {number(), number()}; }
  std::string text() {
    static const std::vector<std::string> kTexts{"", "a", "two words", "Überprüfung ✓", "line\nbreak"};
    return kTexts[rng_.below(kTexts.size())];
  }
  template <class E>
  E one_of(E last) {
    return static_cast<E>(rng_.below(static_cast<std::uint64_t>(last) + 1));
  }
  std::vector<Point2> points() {
    std::vector<Point2> out(static_cast<std::size_t>(count(5)));
    for (Point2& p : out) {
      p = point();
    }
    return out;
  }
  Image image(int most = 20) {
    Image out(count(most), count(most), flag() ? 1 : 3);
    const bool noisy = flag();
    for (auto& byte : out.data()) {
      byte = noisy ? static_cast<std::uint8_t>(rng_.below(256)) : std::uint8_t{7};
    }
    return out;
  }
  LaserScan scan();
  SonarScan sonar();
  OccupancyTile tile();
  api::TileUpdate tiles();
  MapSegment segment();
  api::SegmentUpdate segments();
  api::LineReport lines();
  RobotTopology topology();
  api::MapSummary map_summary();
  api::LandmarkSummary landmark_summary();
  api::LandmarkPoint landmark();
  api::LineMapStatus line_map();
  std::vector<api::StampedPose> trajectory();
  api::Detection detection();
  api::CoverageSummary coverage();
  api::GridReport grid();
  ExploreDecision decision();
  std::vector<api::TargetSpec> targets();
  api::MissionRequest mission();
  api::MissionStatus mission_status();
  PoseEstimate estimate();
  api::RobotStatus status();
  api::RobotInfo info();
  api::ComponentInfo component();
  api::ComponentSetting setting();
  api::LeaseState lease() {
    return {text(), rng_.bits(), text(), flag(), rng_.bits(), std::chrono::milliseconds(count(9000))};
  }
  api::LinkStep link_step() {
    return {std::chrono::milliseconds(1 + count(90'000)), one_of(api::LinkAction::kContinue)};
  }
  api::LinkSteps link_steps();
  api::LinkCountdown link_countdown();
  api::Event event();
  api::ImageFrame frame() { return {text(), {time(), image()}, pose()}; }
  api::DriveCommand drive() {
    return {{number(), number()},
            std::chrono::milliseconds(1 + count(900)),
            rng_.bits(),
            rng_.bits(),
            flag() ? std::optional(time()) : std::nullopt};
  }
  api::Payload payload(api::Topic topic);

 private:
  Rng rng_;
};

}  // namespace seeker::testing
