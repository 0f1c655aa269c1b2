#include "server/vision/multi_recogniser.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "common/core/assert.hpp"
#include "server/vision/feature_recogniser.hpp"
#include "server/vision/overlap.hpp"
#include "server/vision/template_recogniser.hpp"

namespace seeker::vision {
namespace {

/// Grey levels between the darkest and the lightest pixel of a picture that is not "one colour".
constexpr int kMinRange = 8;
constexpr int kMinTargetSide_px = 4;

/// Several recognisers as one.
class MultiRecogniser : public Recogniser {
 public:
  explicit MultiRecogniser(std::vector<std::unique_ptr<Recogniser>> parts) : parts_(std::move(parts)) {}

  [[nodiscard]] Result<RecognitionReport> recognise(const Image& picture) const override {
    RecognitionReport all;
    for (const auto& part : parts_) {
      Result<RecognitionReport> report = part->recognise(picture);
      if (!report) {
        return report;
      }
      all.sightings.insert(all.sightings.end(), report->sightings.begin(), report->sightings.end());
      all.stages += report->stages;
    }
    all.stages.rejected_overlap += suppress_overlaps(all.sightings);
    all.stages.accepted = static_cast<int>(all.sightings.size());
    return all;
  }

  [[nodiscard]] Result<std::vector<StageImage>> explain(const Image& picture) const override {
    std::vector<StageImage> all;
    for (const auto& part : parts_) {
      Result<std::vector<StageImage>> stages = part->explain(picture);
      if (!stages) {
        return stages;
      }
      std::move(stages->begin(), stages->end(), std::back_inserter(all));
    }
    return all;
  }

 private:
  std::vector<std::unique_ptr<Recogniser>> parts_;
};

std::string size_text(int width_px, int height_px) {
  return std::to_string(width_px) + "x" + std::to_string(height_px);
}

Status check_all(const std::vector<TargetModel>& targets, const RecogniserParams& params) {
  if (targets.empty()) {
    return fail(Errc::kInvalidArgument, "no target to look for: name at least one");
  }
  if (targets.size() > kMaxTargets) {
    return fail(Errc::kTooLarge, std::to_string(targets.size()) + " targets at once, at most " +
                                     std::to_string(kMaxTargets) + " are possible");
  }
  const int width_px = params.view.omni ? params.view.omni->width_px : kMaxTargetSide_px;
  const int height_px = params.view.omni ? params.view.omni->height_px : kMaxTargetSide_px;
  for (const TargetModel& target : targets) {
    if (target.kind == TargetKind::kSolid) {
      continue;
    }
    if (Status ok = check_target(target, width_px, height_px); !ok) {
      return ok;
    }
  }
  return validate(params);
}

bool any_of_kind(const std::vector<TargetModel>& targets, TargetKind kind) {
  return std::any_of(targets.begin(), targets.end(), [kind](const TargetModel& t) { return t.kind == kind; });
}

}  // namespace

Status check_target(const TargetModel& target, int scene_width_px, int scene_height_px) {
  const std::string who = "target '" + target.name + "': ";
  const Image& picture = target.picture;
  if (picture.empty()) {
    return fail(Errc::kInvalidArgument, who + "its picture is empty: give a picture of the target");
  }
  if (picture.width_px() > scene_width_px || picture.height_px() > scene_height_px) {
    return fail(Errc::kTooLarge, who + "its picture (" + size_text(picture.width_px(), picture.height_px()) +
                                     ") is larger than the picture searched (" +
                                     size_text(scene_width_px, scene_height_px) + "): scale it down");
  }
  if (std::min(picture.width_px(), picture.height_px()) < kMinTargetSide_px) {
    return fail(Errc::kInvalidArgument, who + "its picture is less than " + std::to_string(kMinTargetSide_px) +
                                            " pixels wide or high: give a larger one");
  }
  const Image grey = to_grey(picture);
  const auto [low, high] = std::minmax_element(grey.data().begin(), grey.data().end());
  if (*high - *low < kMinRange) {
    return fail(Errc::kInvalidArgument, who + "its picture has one colour: give a picture with visible features");
  }
  if (!(target.width_m > 0.0 && target.height_m > 0.0 && target.width_m < std::numeric_limits<double>::infinity() &&
        target.height_m < std::numeric_limits<double>::infinity())) {
    return fail(Errc::kInvalidArgument, who + "its width_m and height_m must be positive and finite");
  }
  return {};
}

Result<std::unique_ptr<Recogniser>> make_recogniser(const std::vector<TargetModel>& targets,
                                                    const RecogniserParams& params) {
  if (Status ok = check_all(targets, params); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  std::vector<std::unique_ptr<Recogniser>> parts;
  if (any_of_kind(targets, TargetKind::kTemplate)) {
    parts.push_back(std::make_unique<TemplateRecogniser>(targets, params));
  }
  if (any_of_kind(targets, TargetKind::kFeature)) {
    Result<std::unique_ptr<FeatureRecogniser>> features = FeatureRecogniser::make(targets, params);
    if (!features) {
      return tl::unexpected<Error>(features.error());
    }
    parts.push_back(std::move(*features));
  }
  if (parts.empty()) {
    return fail(Errc::kInvalidArgument, "no target has a picture to look for");
  }
  return combine(std::move(parts));
}

std::unique_ptr<Recogniser> combine(std::vector<std::unique_ptr<Recogniser>> parts) {
  SEEKER_ASSERT(!parts.empty());
  return std::make_unique<MultiRecogniser>(std::move(parts));
}

}  // namespace seeker::vision
