/// \file
/// The piece that carries the features of one picture between robots, and keeps them on the main robot's disk.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/core/result.hpp"
#include "server/fleet/node_picture.hpp"

namespace seeker::app {

/// The same picture gives the same bytes. Of more than api::kMaxFleetPictureFeatures features the first ones are sent;
/// the pose is rounded to a micrometre.
[[nodiscard]] std::vector<std::uint8_t> encode_picture(const fleet::NodePicture& picture);

/// Trusts nothing. kParse: the bytes are no picture; kTooLarge: it has too many features; kInvalidArgument: there is no
/// pose, a number is not finite, or bearings and descriptors are not equally many.
[[nodiscard]] Result<fleet::NodePicture> decode_picture(std::span<const std::uint8_t> bytes);

}  // namespace seeker::app
