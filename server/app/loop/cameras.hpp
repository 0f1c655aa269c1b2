/// \file
/// Cameras takes pictures on the loop's thread. Recognising targets and finding stereo features are slow: they run in
/// the background when live and inline in lockstep.
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
#include "server/fleet/node_picture.hpp"
#include "server/vision/stereo_features.hpp"

namespace seeker::app {

/// A picture that was taken for the fleet.
struct TakenPicture {
  fleet::NodePicture picture;
  bool at_node = false;  ///< false: of a frame between two nodes, whose features nobody needs
};

/// Owns the recognition and the stereo observation that are in progress. Lives on the loop's thread.
class Cameras {
 public:
  /// `stereo` may be null: no features are found in stereo pictures then. The references outlive the cameras.
  struct Parts {
    const Devices& devices;
    std::shared_ptr<const vision::StereoExtractor> stereo;
    std::shared_ptr<const vision::ViewFeatureExtractor> pictures;  ///< null: no features for the fleet
    WorldLink& world;
    Diagnostics& diagnostics;
    UpdateHub& hub;
  };

  explicit Cameras(const Parts& parts);

  /// True when the robot has a camera and an active recogniser, and no recognition is running or waits for
  /// take_recognition().
  [[nodiscard]] bool can_recognise() const {
    return camera_ != nullptr && !recognition_.busy() && !diagnostics_.components().stopped("recogniser");
  }

  /// Takes a picture and begins to look for targets in it. Call it only when can_recognise() is true. `context` is
  /// where the robot is and what it senses; the stamp becomes that of the exposure.
  void recognise(const std::shared_ptr<const vision::Recogniser>& recogniser, Recognition context);
  /// Returns the sightings once the recognition has finished. When it failed, a fault is raised and nothing is
  /// returned.
  [[nodiscard]] std::optional<Recognition> take_recognition();

  /// Takes a stereo picture and begins to find its features. `context` is where the robot is. Returns the stamp of the
  /// exposure, after which take_look() delivers the features; or an error, after which none follow; or nothing while
  /// the features of an earlier picture are being found.
  [[nodiscard]] std::optional<Result<RobotTime>> look(StereoLook context);
  /// Returns the result of the last look() once it is there.
  [[nodiscard]] std::optional<Result<StereoLook>> take_look();

  /// True when the robot takes pictures for its fleet and none is being worked on or waits for take_described().
  [[nodiscard]] bool can_describe() const { return camera_ != nullptr && describer_ != nullptr && !described_.busy(); }
  /// Takes a picture and begins to extract its features for the fleet. Call it only when can_describe() is true.
  /// `context` is where the robot is. False: the camera failed, which is a fault, and nothing follows.
  bool describe(TakenPicture context);
  /// Returns the features of the last describe() once they are there; nothing when the picture is of no use.
  [[nodiscard]] std::optional<TakenPicture> take_described();

  /// Takes one picture for a client. An unknown camera is kNotFound, and the message lists those that there are.
  [[nodiscard]] Result<api::ImageFrame> grab(const std::string& camera, const Pose2& map_T_base);

 private:
  [[nodiscard]] std::optional<CameraFrame> expose();
  void note_look(const Status& look);
  [[nodiscard]] Error refused(Error error);

  std::shared_ptr<drivers::CameraDriver> camera_;
  std::string camera_name_;
  std::shared_ptr<drivers::StereoDriver> stereo_;
  std::shared_ptr<const vision::StereoExtractor> extractor_;
  std::shared_ptr<const vision::ViewFeatureExtractor> describer_;
  WorldLink& world_;
  Diagnostics& diagnostics_;
  UpdateHub& hub_;
  Background<Recognition> recognition_;
  Background<StereoLook> looks_;
  Background<TakenPicture> described_;
};

}  // namespace seeker::app
