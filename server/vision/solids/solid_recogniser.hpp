/// \file
/// Classification of the solid in a picture of turbid water (spec S6), alone and as a Recogniser for missions.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "common/core/image.hpp"
#include "common/core/solid.hpp"
#include "server/vision/recogniser_params.hpp"
#include "server/vision/sighting.hpp"
#include "server/vision/solids/moment_features.hpp"
#include "server/vision/solids/small_network.hpp"
#include "server/vision/solids/solid_segment.hpp"

namespace seeker::vision {

/// Result of the training.
struct SolidModel {
  SegmentParams segment;
  SmallNetwork network;
  double min_probability = 0.5;  ///< smallest probability of a recognised solid

  friend bool operator==(const SolidModel&, const SolidModel&) = default;
};

/// Fails with kInvalidArgument for parameters outside their range, or a network for other features or classes.
[[nodiscard]] Status validate(const SolidModel& model);
[[nodiscard]] Status validate(const SegmentParams& params);

/// The features of a solid and its position in the picture.
struct SolidSight {
  SolidFeatures features{};
  PixelBox box;
};
/// Extracts the features; no value where the picture shows no region like a solid.
[[nodiscard]] std::optional<SolidSight> look_at_solid(const Image& picture, const SegmentParams& params);

struct ClassifiedSolid {
  SolidKind solid = SolidKind::kSphere;
  std::array<double, kSolidKinds.size()> probabilities{};
  PixelBox box;
};
/// The most probable class, however improbable. No value where no solid is visible. `model` must be valid.
[[nodiscard]] std::optional<ClassifiedSolid> classify_solid(const Image& picture, const SolidModel& model);

/// The solid of each target; no value for other targets.
using WantedSolids = std::vector<std::optional<SolidKind>>;

/// Recognises solids: Sighting::target is an index into `wanted`; the score is the probability. There is at most one
/// sighting.
class SolidRecogniser final : public Recogniser {
 public:
  /// Fails with kInvalidArgument when no solid is wanted, and for an invalid model or an omnidirectional view.
  [[nodiscard]] static Result<std::unique_ptr<SolidRecogniser>> make(const WantedSolids& wanted,
                                                                     const SolidModel& model, const ViewParams& view);

  [[nodiscard]] Result<RecognitionReport> recognise(const Image& picture) const override;
  [[nodiscard]] Result<std::vector<StageImage>> explain(const Image& picture) const override;

 private:
  SolidRecogniser(WantedSolids wanted, SolidModel model, const ViewParams& view)
      : wanted_(std::move(wanted)), model_(std::move(model)), view_(view) {}

  WantedSolids wanted_;
  SolidModel model_;
  ViewParams view_;
};

}  // namespace seeker::vision
