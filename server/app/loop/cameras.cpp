#include "server/app/loop/cameras.hpp"

#include <utility>

namespace seeker::app {
namespace {

Result<Recognition> sightings_in(const vision::Recogniser& recogniser, const Image& picture, Recognition context) {
  Result<vision::RecognitionReport> report = recogniser.recognise(picture);
  if (!report) {
    return tl::unexpected<Error>(report.error());
  }
  context.sightings = std::move(report->sightings);
  return context;
}

Result<StereoLook> features_in(const vision::StereoExtractor& extractor, const StereoFrame& frame, StereoLook look) {
  Result<vision::StereoFeatures> features = extractor.extract(frame);
  if (!features) {
    return tl::unexpected<Error>(features.error());
  }
  look.features = std::move(*features);
  return look;
}

Result<TakenPicture> features_in(const vision::ViewFeatureExtractor& extractor, const Image& picture,
                                 TakenPicture context) {
  Result<vision::ViewFeatures> features = extractor.extract(picture);
  if (!features) {
    return tl::unexpected<Error>(features.error());
  }
  context.picture.features = std::move(*features);
  return context;
}

}  // namespace

Cameras::Cameras(const Parts& parts)
    : camera_(parts.devices.camera),
      camera_name_(parts.devices.camera_name),
      stereo_(parts.devices.stereo),
      extractor_(parts.stereo),
      describer_(parts.pictures),
      world_(parts.world),
      diagnostics_(parts.diagnostics),
      hub_(parts.hub),
      recognition_(parts.devices.clock->lockstep(), "the recogniser failed on a picture"),
      looks_(parts.devices.clock->lockstep(), "a stereo picture could not be looked at"),
      described_(parts.devices.clock->lockstep(), "the features of a picture could not be extracted") {}

/// A failure is a fault of the camera, or of the world that it shows.
std::optional<CameraFrame> Cameras::expose() {
  Result<CameraFrame> frame = camera_->grab();
  if (!frame && !world_.check()) {
    return std::nullopt;
  }
  if (!frame) {
    diagnostics_.raise("camera-failed", "camera", "camera: " + frame.error().message,
                       "check the camera, then 'seeker components --restart camera'");
    return std::nullopt;
  }
  diagnostics_.clear("camera-failed");
  diagnostics_.components().count_output("camera", "picture", world_.now());
  return std::move(*frame);
}

void Cameras::recognise(const std::shared_ptr<const vision::Recogniser>& recogniser, Recognition context) {
  std::optional<CameraFrame> frame = expose();
  if (!frame) {
    return;
  }
  if (hub_.wanted(api::Topic::kImage)) {
    hub_.publish(api::Topic::kImage, world_.now(),
                 api::ImageFrame{.camera = camera_name_, .frame = *frame, .map_T_base = context.map_T_base});
  }
  context.stamp = frame->stamp;
  recognition_.start([recogniser, context = std::move(context), picture = std::move(frame->image)] {
    return sightings_in(*recogniser, picture, context);
  });
}

std::optional<Recognition> Cameras::take_recognition() {
  std::optional<Result<Recognition>> answer = recognition_.take();
  if (!answer) {
    return std::nullopt;
  }
  diagnostics_.note_work("recogniser", recognition_.took());
  if (!*answer) {
    diagnostics_.raise("recogniser-failed", "recogniser", answer->error().message,
                       "check the camera's picture with 'seeker camera grab'", api::Severity::kWarning);
    return std::nullopt;
  }
  diagnostics_.components().count_output("recogniser", "sightings", world_.now());
  return std::move(**answer);
}

bool Cameras::describe(TakenPicture context) {
  std::optional<CameraFrame> frame = expose();
  if (!frame) {
    return false;
  }
  described_.start([extractor = describer_, context = std::move(context), picture = std::move(frame->image)] {
    return features_in(*extractor, picture, context);
  });
  return true;
}

std::optional<TakenPicture> Cameras::take_described() {
  std::optional<Result<TakenPicture>> answer = described_.take();
  if (!answer) {
    return std::nullopt;
  }
  diagnostics_.note_work("node-picture", described_.took());
  if (!*answer) {
    diagnostics_.raise("pictures-failed", "camera", answer->error().message,
                       "check the camera's picture with 'seeker camera grab'", api::Severity::kWarning);
    return std::nullopt;
  }
  diagnostics_.clear("pictures-failed");
  return std::move(**answer);
}

void Cameras::note_look(const Status& look) {
  if (look) {
    diagnostics_.clear("stereo-failed");
  } else if (world_.check()) {
    diagnostics_.raise("stereo-failed", "stereo", "stereo camera: " + look.error().message,
                       "check the camera, then 'seeker components --restart stereo'", api::Severity::kWarning);
  }
}

Error Cameras::refused(Error error) {
  note_look(tl::unexpected<Error>(error));
  return error;
}

std::optional<Result<RobotTime>> Cameras::look(StereoLook context) {
  if (stereo_ == nullptr || extractor_ == nullptr) {
    return tl::unexpected<Error>(refused({Errc::kNotReady, "this robot has no stereo camera"}));
  }
  if (looks_.busy()) {
    return std::nullopt;
  }
  Result<StereoFrame> frame = stereo_->grab();
  if (!frame) {
    return tl::unexpected<Error>(refused(frame.error()));
  }
  diagnostics_.components().count_output("stereo", "pictures", world_.now());
  const RobotTime stamp = frame->stamp;
  context.stamp = stamp;
  looks_.start([extractor = extractor_, context = std::move(context), frame = std::move(*frame)] {
    return features_in(*extractor, frame, context);
  });
  return stamp;
}

std::optional<Result<StereoLook>> Cameras::take_look() {
  std::optional<Result<StereoLook>> look = looks_.take();
  if (look) {
    diagnostics_.note_work("stereo", looks_.took());
    note_look(*look ? Status() : Status(tl::unexpected<Error>(look->error())));
  }
  return look;
}

Result<api::ImageFrame> Cameras::grab(const std::string& camera, const Pose2& map_T_base) {
  if (stereo_ != nullptr && (camera == "left" || camera == "right")) {
    Result<StereoFrame> frame = stereo_->grab();
    if (!frame) {
      return tl::unexpected<Error>(frame.error());
    }
    Image& eye = camera == "left" ? frame->left : frame->right;
    return api::ImageFrame{.camera = camera, .frame = {frame->stamp, std::move(eye)}, .map_T_base = map_T_base};
  }
  if (camera_ == nullptr || (!camera.empty() && camera != camera_name_)) {
    std::string there = camera_ != nullptr ? camera_name_ : "";
    there += stereo_ != nullptr ? std::string(there.empty() ? "" : ", ") + "left, right" : "";
    return fail(Errc::kNotFound,
                there.empty() ? "this robot has no camera" : "no camera '" + camera + "'; there are: " + there);
  }
  Result<CameraFrame> frame = camera_->grab();
  if (!frame) {
    return tl::unexpected<Error>(frame.error());
  }
  return api::ImageFrame{.camera = camera_name_, .frame = std::move(*frame), .map_T_base = map_T_base};
}

}  // namespace seeker::app
