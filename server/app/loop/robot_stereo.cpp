// Looking with both eyes: pictures are taken in the loop, features are found in the background when live.

#include "server/app/loop/robot_loop.hpp"

namespace seeker::app {

void RobotLoop::look_with_both() {
  if (parts_.devices.stereo == nullptr || parts_.stereo == nullptr) {
    give_look(fail(Errc::kNotReady, "this robot has no stereo camera"));
    return;
  }
  if (looks_.busy()) {
    return;
  }
  Result<StereoFrame> frame = parts_.devices.stereo->grab();
  if (!frame) {
    give_look(tl::unexpected<Error>(frame.error()));
    return;
  }
  components_.count_output("stereo", now());
  StereoLook context;
  context.stamp = frame->stamp;
  context.pose = pose_;
  context.odom_T_base = odometry_ ? odometry_->odom_T_base : Pose2{};
  parts_.estimator->look_begun(context.stamp);
  looks_.start(
      [extractor = parts_.stereo, context = std::move(context), frame = std::move(*frame)]() -> Result<StereoLook> {
        Result<vision::StereoFeatures> features = extractor->extract(frame);
        if (!features) {
          return tl::unexpected<Error>(features.error());
        }
        StereoLook look = context;
        look.features = std::move(*features);
        return look;
      });
  take_look();  // inline: the answer is there at once
}

void RobotLoop::take_look() {
  if (const std::optional<Result<StereoLook>> look = looks_.take()) {
    give_look(*look);
  }
}

void RobotLoop::give_look(const Result<StereoLook>& look) {
  if (look) {
    clear("stereo-failed");
  } else if (world_there()) {
    raise("stereo-failed", "stereo", "stereo camera: " + look.error().message,
          "check the camera, then 'seeker components --restart stereo'", api::Severity::kWarning);
  }
  parts_.estimator->on_look(look);
  for (const std::string& news : parts_.estimator->take_news()) {
    log("landmarks", news);
  }
  if (look_for_mission_) {
    look_for_mission_ = false;
    missions_.on_look(look);
  }
}

void RobotLoop::place_at(const PoseEstimate& place) {
  const bool in_map = parts_.estimator->map_tracker() != nullptr;
  const Status placed = in_map ? map_.relocalise(place.map_T_base, now()) : parts_.estimator->place_at(place);
  pose_ = map_.follow(parts_.estimator->estimate(), now());
  log("placed", placed ? "the estimator takes the place that was found" : placed.error().message,
      placed ? api::Severity::kInfo : api::Severity::kWarning);
}

}  // namespace seeker::app
