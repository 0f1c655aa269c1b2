#include "server/app/fleet/picture_piece.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "common/api/fleet.hpp"
#include "common/core/angle.hpp"
#include "common/wire/convert.hpp"
#include "seeker/v1/fleet.pb.h"

namespace seeker::app {
namespace {

constexpr double kStepsPerUnit = 1e6;  ///< of metres and radians

double to_step(double value) { return std::round(value * kStepsPerUnit) / kStepsPerUnit; }

}  // namespace

std::vector<std::uint8_t> encode_picture(const fleet::NodePicture& picture) {
  const vision::ViewFeatures& features = picture.features;
  const std::size_t count = std::min(features.size(), api::kMaxFleetPictureFeatures);
  v1::FleetPictureFeatures message;
  message.set_node(picture.node);
  wire::write(Pose2{to_step(picture.node_T_base.x_m), to_step(picture.node_T_base.y_m),
                    to_step(wrap_angle(picture.node_T_base.theta_rad))},
              message.mutable_node_t_base());
  std::string& descriptors = *message.mutable_descriptors();
  descriptors.reserve(count * vision::kDescriptorSize);
  for (std::size_t k = 0; k < count; ++k) {
    message.add_bearings(features.bearings_rad[k]);
    descriptors.append(features.descriptors[k].begin(), features.descriptors[k].end());
  }
  std::vector<std::uint8_t> bytes(message.ByteSizeLong());
  message.SerializeToArray(bytes.data(), static_cast<int>(bytes.size()));
  return bytes;
}

Result<fleet::NodePicture> decode_picture(std::span<const std::uint8_t> bytes) {
  v1::FleetPictureFeatures message;
  if (bytes.size() > api::kMaxFleetPictureBytes ||
      !message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) {
    return fail(Errc::kParse, "a piece is not the picture that was announced");
  }
  const auto count = static_cast<std::size_t>(message.bearings_size());
  if (count > api::kMaxFleetPictureFeatures) {
    return fail(Errc::kTooLarge,
                "a picture has more than " + std::to_string(api::kMaxFleetPictureFeatures) + " features");
  }
  const Result<Pose2> node_T_base = wire::from_message<Pose2>(message.node_t_base());
  if (!message.has_node_t_base() || !node_T_base || message.descriptors().size() != count * vision::kDescriptorSize ||
      !std::all_of(message.bearings().begin(), message.bearings().end(), [](float b) { return std::isfinite(b); })) {
    return fail(Errc::kInvalidArgument, "a picture has no pose, or its features are not complete");
  }
  fleet::NodePicture picture;
  picture.node = message.node();
  picture.node_T_base = *node_T_base;
  picture.features.bearings_rad.assign(message.bearings().begin(), message.bearings().end());
  picture.features.descriptors.resize(count);
  const std::string& descriptors = message.descriptors();
  for (std::size_t k = 0; k < count; ++k) {
    const auto begin = descriptors.begin() + static_cast<std::ptrdiff_t>(k * vision::kDescriptorSize);
    std::transform(begin, begin + vision::kDescriptorSize, picture.features.descriptors[k].begin(),
                   [](char byte) { return static_cast<std::uint8_t>(byte); });
  }
  return picture;
}

}  // namespace seeker::app
