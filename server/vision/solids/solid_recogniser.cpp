#include "server/vision/solids/solid_recogniser.hpp"

#include <algorithm>
#include <utility>

#include "common/core/assert.hpp"
#include "server/vision/photo_view.hpp"
#include "server/vision/picture.hpp"

namespace seeker::vision {
namespace {

Status refuse(const char* why) { return fail(Errc::kInvalidArgument, std::string("recogniser of solids: ") + why); }

tl::unexpected<Error> no_picture() {
  return fail(Errc::kInvalidArgument, "recogniser of solids: the picture is empty");
}

/// How far behind the lower edge of what is seen its middle stands, as a share of the width that is seen: the mean over
/// the views of spec S6.
double share_behind(SolidKind solid) {
  switch (solid) {
    case SolidKind::kSphere: return 0.18;
    case SolidKind::kTriangularPrism: return 0.40;
    case SolidKind::kQuadrangularPrism: return 0.50;
    case SolidKind::kEllipsoid: return 0.14;
  }
  return 0.0;
}

void place_on_floor(const PhotoView& view, SolidKind solid, Sighting& sighting) {
  const double low_px = sighting.box.top_px + sighting.box.height_px - 1.0;
  sighting.bearing_base_rad = view.bearing_rad(sighting.u_px, sighting.v_px);
  const std::optional<double> near_m = view.floor_range_m(sighting.u_px, low_px);
  const std::optional<double> scale_m = view.floor_scale_m(sighting.u_px, low_px);
  if (near_m && scale_m) {
    sighting.floor_range_m = *near_m + share_behind(solid) * sighting.box.width_px * *scale_m;
    sighting.range_m = sighting.floor_range_m;
  }
}

}  // namespace

Status validate(const SegmentParams& p) {
  const auto odd = [](int side) {
    constexpr int kMost = 99;
    return side >= 1 && side <= kMost && side % 2 == 1;
  };
  const bool shares = p.min_area > 0.0 && p.max_area <= 1.0 && p.min_area < p.max_area && p.stretch_low >= 0.0 &&
                      p.stretch_high <= 1.0 && p.stretch_low < p.stretch_high;
  constexpr double kWidest_px = 1000.0;
  if (!shares || !odd(p.opening_px) || !odd(p.closing_px) || !(p.light_sigma_px >= 8.0) ||
      !(p.light_sigma_px <= kWidest_px) || !(p.floor_sigmas >= 0.0) || !(p.contrast_sigmas >= 0.0) ||
      !(p.face_share >= 0.0 && p.face_share <= 1.0)) {
    return refuse("a parameter of the segmentation is outside its range (opening_px and closing_px are odd)");
  }
  return {};
}

Status validate(const SolidModel& model) {
  if (const Status segment = validate(model.segment); !segment) {
    return segment;
  }
  if (const Status network = validate(model.network); !network) {
    return network;
  }
  if (model.network.inputs != static_cast<int>(kSolidFeatures) ||
      model.network.outputs != static_cast<int>(kSolidKinds.size())) {
    return refuse("the network is not for 14 moments and 4 classes; train it with seeker-lab train-solids");
  }
  if (!(model.min_probability >= 0.0 && model.min_probability <= 1.0)) {
    return refuse("min_probability must be from 0 to 1");
  }
  return {};
}

std::optional<SolidSight> look_at_solid(const Image& picture, const SegmentParams& params) {
  if (picture.empty()) {
    return std::nullopt;
  }
  const std::optional<SolidRegion> region = segment_solid(to_grey_mat(picture), params);
  if (!region) {
    return std::nullopt;
  }
  return SolidSight{solid_features(region->mask, region->even),
                    {region->box.x, region->box.y, region->box.width, region->box.height}};
}

std::optional<ClassifiedSolid> classify_solid(const Image& picture, const SolidModel& model) {
  const std::optional<SolidSight> sight = look_at_solid(picture, model.segment);
  if (!sight) {
    return std::nullopt;
  }
  const std::vector<double> output = run_network(model.network, {sight->features.begin(), sight->features.end()});
  SEEKER_ASSERT(output.size() == kSolidKinds.size());
  ClassifiedSolid solid;
  std::copy(output.begin(), output.end(), solid.probabilities.begin());
  solid.solid = static_cast<SolidKind>(std::max_element(output.begin(), output.end()) - output.begin());
  solid.box = sight->box;
  return solid;
}

Result<std::unique_ptr<SolidRecogniser>> SolidRecogniser::make(const WantedSolids& wanted, const SolidModel& model,
                                                               const ViewParams& view) {
  if (const Status valid = validate(model); !valid) {
    return tl::unexpected<Error>(valid.error());
  }
  const bool any = std::any_of(wanted.begin(), wanted.end(), [](const auto& solid) { return solid.has_value(); });
  if (!any || view.omni) {
    return fail(Errc::kInvalidArgument,
                "recogniser of solids: name at least one solid, and a camera that is not omnidirectional");
  }
  return std::unique_ptr<SolidRecogniser>(new SolidRecogniser(wanted, model, view));
}

Result<RecognitionReport> SolidRecogniser::recognise(const Image& picture) const {
  if (picture.empty()) {
    return no_picture();
  }
  RecognitionReport report;
  const std::optional<ClassifiedSolid> solid = classify_solid(picture, model_);
  if (!solid) {
    return report;
  }
  report.stages.regions = 1;
  const auto place = std::find(wanted_.begin(), wanted_.end(), solid->solid);
  const double probability = solid->probabilities[static_cast<std::size_t>(solid->solid)];
  report.stages.candidates = place == wanted_.end() ? 0 : 1;
  if (place == wanted_.end() || probability < model_.min_probability) {
    report.stages.rejected_verify = report.stages.candidates;
    return report;
  }
  Sighting sighting;
  sighting.target = static_cast<int>(place - wanted_.begin());
  sighting.box = solid->box;
  sighting.u_px = solid->box.left_px + (solid->box.width_px - 1) / 2.0;
  sighting.v_px = solid->box.top_px + (solid->box.height_px - 1) / 2.0;
  sighting.score = sighting.verify_score = probability;
  sighting.size = {static_cast<double>(solid->box.width_px), static_cast<double>(solid->box.height_px)};
  place_on_floor(PhotoView(view_, picture.width_px(), picture.height_px()), solid->solid, sighting);
  report.stages.accepted = 1;
  report.sightings.push_back(sighting);
  return report;
}

Result<std::vector<StageImage>> SolidRecogniser::explain(const Image& picture) const {
  if (picture.empty()) {
    return no_picture();
  }
  std::vector<StageImage> stages{{"grey", to_grey(picture)}};
  if (const std::optional<SolidRegion> region = segment_solid(to_grey_mat(picture), model_.segment)) {
    stages.push_back({"even_light", to_image(region->even)});
    stages.push_back({"solid", to_image(region->mask)});
  }
  return stages;
}

}  // namespace seeker::vision
