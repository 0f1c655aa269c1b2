/// \file
/// Which solid a picture of turbid water shows (spec S6), alone and as a Recogniser for missions.
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

/// What training gives.
struct SolidModel {
  SegmentParams segment;
  SmallNetwork network;
  double min_probability = 0.5;  ///< below, a picture shows no solid that is known

  friend bool operator==(const SolidModel&, const SolidModel&) = default;
};

/// kInvalidArgument: parameters outside their range, a network for other features or classes.
[[nodiscard]] Status validate(const SolidModel& model);
[[nodiscard]] Status validate(const SegmentParams& params);

/// The solid's features and where it is. Nothing where the picture shows no region like a solid.
struct SolidSight {
  SolidFeatures features{};
  PixelBox box;
};
[[nodiscard]] std::optional<SolidSight> look_at_solid(const Image& picture, const SegmentParams& params);

struct ClassifiedSolid {
  SolidKind solid = SolidKind::kSphere;
  std::array<double, kSolidKinds.size()> probabilities{};
  PixelBox box;
};
/// The most probable class, however improbable. Nothing where no solid is seen. `model` must be valid.
[[nodiscard]] std::optional<ClassifiedSolid> classify_solid(const Image& picture, const SolidModel& model);

/// Which solid each target is; nothing where a target is none.
using WantedSolids = std::vector<std::optional<SolidKind>>;

/// Sighting::target counts in `wanted`; score is the probability. There is one sighting at most.
class SolidRecogniser final : public Recogniser {
 public:
  /// kInvalidArgument: nothing wanted, an invalid model, an omnidirectional view.
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
