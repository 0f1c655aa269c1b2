/// \file
/// The factory that makes one recogniser for a list of targets.
#pragma once

#include <memory>
#include <vector>

#include "server/vision/recogniser_params.hpp"
#include "server/vision/sighting.hpp"

namespace seeker::vision {

/// Largest accepted side of a target's picture.
inline constexpr int kMaxTargetSide_px = 2048;
/// Largest number of targets.
inline constexpr int kMaxTargets = 64;

/// Makes one template recogniser for all targets of kind kTemplate and one feature recogniser for all of kind kFeature;
/// the sightings of both are returned, best first, never two targets at one position. Sighting::target is an index into
/// `targets`. Solids are skipped: see make_target_recogniser() in server/vision/solids. Fails with kInvalidArgument
/// without a target, for a picture that is empty, of one colour or without features, and for invalid parameters; fails
/// with kTooLarge for a picture larger than the camera's (omnidirectional) or than kMaxTargetSide_px.
[[nodiscard]] Result<std::unique_ptr<Recogniser>> make_recogniser(const std::vector<TargetModel>& targets,
                                                                  const RecogniserParams& params = {});

/// Combines several recognisers: sightings of all, best first, never two targets at one position. Requires at least
/// one.
[[nodiscard]] std::unique_ptr<Recogniser> combine(std::vector<std::unique_ptr<Recogniser>> parts);

/// Refuses a target's picture for a scene of the given size when it is empty, larger than the scene or of one colour.
[[nodiscard]] Status check_target(const TargetModel& target, int scene_width_px, int scene_height_px);

}  // namespace seeker::vision
