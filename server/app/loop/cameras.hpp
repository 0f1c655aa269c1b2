/// \file
/// The robot's cameras: pictures are taken on the loop's thread; what is slow about them, recognising targets and
/// finding stereo features, runs in the background when live and inline in lockstep.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "common/api/robot_api.hpp"
#include "server/app/estimators/stereo_look.hpp"
#include "server/app/loop/diagnostics.hpp"
#include "server/app/loop/world_link.hpp"
#include "server/app/missions/behaviour.hpp"
#include "server/app/runtime/background.hpp"
#include "server/app/runtime/devices.hpp"
#include "server/app/runtime/update_hub.hpp"
#include "server/vision/stereo_features.hpp"

namespace seeker::app {

/// Owner of what is being recognised and looked at. Lives on the loop's thread.
class Cameras {
 public:
  /// `stereo` may be null: no features are found in stereo pictures then. The references outlive the cameras.
  struct Parts {
    const Devices& devices;
    std::shared_ptr<const vision::StereoExtractor> stereo;
    WorldLink& world;
    Diagnostics& diagnostics;
    UpdateHub& hub;
  };

  explicit Cameras(const Parts& parts);

  /// There is a camera, and no picture of it is being looked at.
  [[nodiscard]] bool can_recognise() const { return camera_ != nullptr && !recognition_.busy(); }

  /// Takes a picture and begins to look for targets in it; only where can_recognise(). `context` is where the robot is
  /// and what it senses; the stamp becomes that of the exposure.
  void recognise(const std::shared_ptr<const vision::Recogniser>& recogniser, Recognition context);
  /// The sightings, once they are there. A recogniser that failed is a fault, and there is nothing.
  [[nodiscard]] std::optional<Recognition> take_recognition();

  /// Takes a stereo picture and begins to find its features. `context` is where the robot is. Returns the stamp of the
  /// exposure, with the answer to come from take_look(); an error, which is the answer itself; or nothing while the
  /// features of an earlier picture are being found.
  [[nodiscard]] std::optional<Result<RobotTime>> look(StereoLook context);
  [[nodiscard]] std::optional<Result<StereoLook>> take_look();

  /// One picture for a client. kNotFound names the cameras there are.
  [[nodiscard]] Result<api::ImageFrame> grab(const std::string& camera, const Pose2& map_T_base);

 private:
  void note_look(const Status& look);
  [[nodiscard]] Error refused(Error error);

  std::shared_ptr<drivers::CameraDriver> camera_;
  std::string camera_name_;
  std::shared_ptr<drivers::StereoDriver> stereo_;
  std::shared_ptr<const vision::StereoExtractor> extractor_;
  WorldLink& world_;
  Diagnostics& diagnostics_;
  UpdateHub& hub_;
  Background<Recognition> recognition_;
  Background<StereoLook> looks_;
};

}  // namespace seeker::app
