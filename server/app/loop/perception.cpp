#include "server/app/loop/perception.hpp"

#include <utility>

namespace seeker::app {

std::string_view to_string(PicturesAt at) {
  switch (at) {
    case PicturesAt::kNever: return "never";
    case PicturesAt::kNodes: return "nodes";
    case PicturesAt::kFrames: return "frames";
  }
  return "unknown";
}

Perception::Perception(const Cameras::Parts& parts, const NodePictureParams& pictures, const Sensing& sensing,
                       Localiser& localiser, MissionExecutor& missions)
    : cameras_(parts), pictures_(pictures), sensing_(sensing), localiser_(localiser), missions_(missions) {}

void Perception::take_answers() {
  take_recognition();
  take_look();
}

void Perception::look_for_targets() {
  const Behaviour* behaviour = missions_.behaviour();
  const auto recogniser = behaviour != nullptr ? behaviour->recogniser() : nullptr;
  if (recogniser == nullptr || !cameras_.can_recognise()) {
    return;
  }
  Recognition context;
  context.map_T_base = localiser_.pose().map_T_base;
  const RangeInputs& inputs = sensing_.connections().planner;
  if (const LaserScan* scan = sensing_.scan_for(inputs)) {
    context.scan = *scan;
  }
  if (const SonarScan* sonar = sensing_.sonar_for(inputs)) {
    context.sonar = *sonar;
  }
  cameras_.recognise(recogniser, std::move(context));
  take_recognition();  // inline: the answer is there at once
}

void Perception::take_recognition() {
  if (const std::optional<Recognition> recognition = cameras_.take_recognition()) {
    missions_.on_recognition(*recognition);
  }
}

void Perception::look_with_both(bool for_mission) {
  mission_waits_ = mission_waits_ || for_mission;
  StereoLook context;
  context.pose = localiser_.pose();
  context.odom_T_base = sensing_.odom_T_base();
  const std::optional<Result<RobotTime>> begun = cameras_.look(std::move(context));
  if (!begun) {
    return;
  }
  if (!*begun) {
    give_look(tl::unexpected<Error>(begun->error()));
    return;
  }
  localiser_.look_begun(**begun);
  take_look();  // inline: the answer is there at once
}

void Perception::take_look() {
  if (const std::optional<Result<StereoLook>> look = cameras_.take_look()) {
    give_look(*look);
  }
}

void Perception::give_look(const Result<StereoLook>& look) {
  localiser_.on_look(look);
  if (std::exchange(mission_waits_, false)) {
    missions_.on_look(look);
  }
}

void Perception::look_for_fleet(Neighbours& neighbours, RobotTime now) {
  take_described(neighbours);
  const bool frame = pictures_.at == PicturesAt::kFrames && now >= next_frame_;
  const bool node = neighbours.wants_picture();
  const PoseEstimate& pose = localiser_.pose();
  if ((!node && !frame) || !cameras_.can_describe() || !is_placed(pose.quality) || localiser_.tracker() == nullptr) {
    return;
  }
  const std::vector<slam::MapPiece> pieces = localiser_.tracker()->pieces();
  if (pieces.empty()) {
    return;
  }
  next_frame_ = now + pictures_.frame_period;
  const slam::MapPiece& newest = pieces.back();  // the robot's pose is known best in that one
  TakenPicture context;
  context.picture.node = newest.id;
  context.picture.node_T_base = inverse(newest.map_T_piece) * pose.map_T_base;
  context.at_node = node;
  if (cameras_.describe(std::move(context)) && node) {
    neighbours.picture_begun();
  }
  take_described(neighbours);  // inline: the features are there at once
}

void Perception::take_described(Neighbours& neighbours) {
  std::optional<TakenPicture> taken = cameras_.take_described();
  if (!taken) {
    return;
  }
  ++picture_work_.pictures;
  picture_work_.features += taken->picture.features.size();
  if (taken->at_node) {
    ++picture_work_.kept;
    neighbours.keep_picture(std::move(taken->picture));
  }
}

Result<api::ImageFrame> Perception::grab(const std::string& camera) {
  return cameras_.grab(camera, localiser_.pose().map_T_base);
}

}  // namespace seeker::app
