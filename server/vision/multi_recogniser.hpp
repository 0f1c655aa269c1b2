/// \file
/// The factory: from a list of targets to one recogniser that finds them all.
#pragma once

#include <memory>
#include <vector>

#include "server/vision/recogniser_params.hpp"
#include "server/vision/sighting.hpp"

namespace seeker::vision {

/// Longest side of a target's picture that is accepted.
inline constexpr int kMaxTargetSide_px = 2048;
/// Most targets at once.
inline constexpr int kMaxTargets = 64;

/// Builds what the targets need: one template recogniser for all of kind kTemplate, one feature recogniser for all of
/// kind kFeature; sightings of both, best first, never two targets at one place. Sighting::target counts in `targets`.
/// Solids are passed over: see make_target_recogniser() in server/vision/solids.
/// kInvalidArgument: no target, or a picture that is empty, one colour or without features; bad parameters.
/// kTooLarge: a picture larger than the camera's (omnidirectional) or than kMaxTargetSide_px.
[[nodiscard]] Result<std::unique_ptr<Recogniser>> make_recogniser(const std::vector<TargetModel>& targets,
                                                                  const RecogniserParams& params = {});

/// Several recognisers as one: sightings of all, best first, never two targets at one place. Asserts that there is one.
[[nodiscard]] std::unique_ptr<Recogniser> combine(std::vector<std::unique_ptr<Recogniser>> parts);

/// Refuses a target's picture for a scene of the given size: empty, larger than the scene, one colour.
[[nodiscard]] Status check_target(const TargetModel& target, int scene_width_px, int scene_height_px);

}  // namespace seeker::vision
