#include "server/app/loop/perception.hpp"

#include <utility>

namespace seeker::app {

Perception::Perception(const Cameras::Parts& parts, const Sensing& sensing, Localiser& localiser,
                       MissionExecutor& missions)
    : cameras_(parts), sensing_(sensing), localiser_(localiser), missions_(missions) {}

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

Result<api::ImageFrame> Perception::grab(const std::string& camera) {
  return cameras_.grab(camera, localiser_.pose().map_T_base);
}

}  // namespace seeker::app
