#include "server/vision/template_recogniser.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "server/vision/candidate_match.hpp"
#include "server/vision/overlap.hpp"
#include "server/vision/picture.hpp"
#include "server/vision/stage_pictures.hpp"

namespace seeker::vision {
namespace {

constexpr int kMinRegionSide_px = 5;
/// A region fills at least this share of its box: thinner ones are lines and noise.
constexpr double kMinFill = 0.12;
/// Bound on the work in one picture; the largest regions are kept.
constexpr std::size_t kMaxRegions = 600;
constexpr int kSameBox_px = 1;

bool same_box(const Region& a, const Region& b) {
  const auto near = [](int x, int y) { return std::abs(x - y) <= kSameBox_px; };
  return a.light == b.light && near(a.box.x, b.box.x) && near(a.box.y, b.box.y) && near(a.box.width, b.box.width) &&
         near(a.box.height, b.box.height);
}

std::array<cv::Point2d, 4> corners_of(const cv::Rect2d& box) {
  // Edges to pixel centres: half a pixel.
  const double left = box.x - 0.5;
  const double top = box.y - 0.5;
  return {cv::Point2d(left, top), cv::Point2d(left + box.width, top), cv::Point2d(left + box.width, top + box.height),
          cv::Point2d(left, top + box.height)};
}

}  // namespace

TemplateRecogniser::TemplateRecogniser(const std::vector<TargetModel>& targets, const RecogniserParams& params)
    : params_(params), view_(params.view) {
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (targets[i].kind != TargetKind::kTemplate) {
      continue;
    }
    const Image& picture = targets[i].picture;
    widest_px_ = std::max(widest_px_, picture.width_px());
    highest_px_ = std::max(highest_px_, picture.height_px());
    targets_.push_back(
        make_target_template(to_grey_mat(picture), static_cast<int>(i), targets[i].height_m, params_.templates));
    for (const TemplateVariant& variant : targets_.back().variants) {
      for (const Anchor& anchor : variant.anchors) {
        smallest_part_ = std::min(smallest_part_, anchor.part.area());
      }
    }
  }
}

Status TemplateRecogniser::check_pictures(const Image& picture) const {
  if (widest_px_ > picture.width_px() || highest_px_ > picture.height_px()) {
    return fail(Errc::kTooLarge, "a target's picture (" + std::to_string(widest_px_) + "x" +
                                     std::to_string(highest_px_) + ") is larger than the picture searched (" +
                                     std::to_string(picture.width_px()) + "x" + std::to_string(picture.height_px()) +
                                     "): scale the target's picture down");
  }
  return {};
}

bool TemplateRecogniser::area_fits(const Region& region, double reference_area_px) const {
  // The area of a framed sign is that of its box: its inside belongs to it.
  const double area_px = region.box.area();
  return std::min(region.box.width, region.box.height) >= kMinRegionSide_px && region.area_px >= kMinFill * area_px &&
         area_px <= params_.templates.max_area * reference_area_px &&
         area_px >= params_.templates.min_area * reference_area_px * smallest_part_;
}

std::vector<Region> TemplateRecogniser::candidate_regions(const std::vector<Binarisation>& binarisations,
                                                          double reference_area_px, StageCounts& stages) const {
  std::vector<Region> kept;
  for (const Binarisation& binarisation : binarisations) {
    for (const Region& region : grow_regions(binarisation.classes)) {
      ++stages.regions;
      if (!area_fits(region, reference_area_px)) {
        ++stages.rejected_area;
      } else if (std::any_of(kept.begin(), kept.end(), [&region](const Region& k) { return same_box(k, region); })) {
        ++stages.rejected_duplicate;
      } else {
        kept.push_back(region);
      }
    }
  }
  if (kept.size() > kMaxRegions) {
    std::stable_sort(kept.begin(), kept.end(),
                     [](const Region& a, const Region& b) { return a.box.area() > b.box.area(); });
    stages.rejected_area += static_cast<int>(kept.size() - kMaxRegions);
    kept.resize(kMaxRegions);
  }
  return kept;
}

void TemplateRecogniser::match_variant(const TargetTemplate& target, const TemplateVariant& variant,
                                       const std::vector<Region>& regions, const GreyPyramid& scene,
                                       const cv::Size& working, RecognitionReport& report) const {
  for (const Region& region : regions) {
    for (const Anchor& anchor : variant.anchors) {
      if (anchor.light && *anchor.light != region.light) {
        continue;
      }
      if (!anchor.fits(region.box, params_.templates.aspect_tolerance)) {
        ++report.stages.rejected_aspect;
        continue;
      }
      ++report.stages.candidates;
      const CandidateMatch match = match_candidate(scene, variant, anchor.whole(region.box), params_.templates);
      if (match.outcome != MatchOutcome::kAccepted) {
        ++(match.outcome == MatchOutcome::kRejectedNcc ? report.stages.rejected_ncc : report.stages.rejected_verify);
        continue;
      }
      Sighting sighting;
      sighting.target = target.target;
      sighting.score = match.ncc;
      sighting.verify_score = match.gradient_ncc;
      view_.locate(corners_of(variant.whole(match.box)), working, target.height_m, sighting);
      report.sightings.push_back(sighting);
    }
  }
}

void TemplateRecogniser::match_target(const TargetTemplate& target, const std::vector<Region>& regions,
                                      const GreyPyramid& scene, const cv::Size& working,
                                      RecognitionReport& report) const {
  for (const TemplateVariant& variant : target.variants) {
    match_variant(target, variant, regions, scene, working, report);
  }
}

Result<RecognitionReport> TemplateRecogniser::recognise(const Image& picture) const {
  const Result<cv::Mat> grey = view_.working_picture(picture);
  if (!grey) {
    return tl::unexpected<Error>(grey.error());
  }
  if (const Status size = check_pictures(picture); !size) {
    return tl::unexpected<Error>(size.error());
  }
  RecognitionReport report;
  const std::vector<Binarisation> binarisations =
      binarise(preprocess(*grey, params_.templates).denoised, params_.templates);
  const std::vector<Region> regions = candidate_regions(binarisations, view_.reference_area_px(picture), report.stages);
  const GreyPyramid scene(*grey);
  for (const TargetTemplate& target : targets_) {
    match_target(target, regions, scene, grey->size(), report);
  }
  report.stages.rejected_overlap = suppress_overlaps(report.sightings);
  if (params_.templates.only_best) {
    report.stages.rejected_overlap += keep_first_of_each_target(report.sightings);
  }
  report.stages.accepted = static_cast<int>(report.sightings.size());
  return report;
}

Result<std::vector<StageImage>> TemplateRecogniser::explain(const Image& picture) const {
  const Result<RecognitionReport> report = recognise(picture);
  if (!report) {
    return tl::unexpected<Error>(report.error());
  }
  const cv::Mat grey = *view_.working_picture(picture);
  const Preprocessed steps = preprocess(grey, params_.templates);
  const std::vector<Binarisation> binarisations = binarise(steps.denoised, params_.templates);
  StageCounts counts;
  const std::vector<Region> regions = candidate_regions(binarisations, view_.reference_area_px(picture), counts);
  std::vector<StageImage> out;
  out.push_back({"grey", to_image(grey)});
  out.push_back({"smoothed", to_image(steps.smoothed)});
  out.push_back({"stretched", to_image(steps.stretched)});
  out.push_back({"denoised", to_image(steps.denoised)});
  for (const Binarisation& binarisation : binarisations) {
    out.push_back({"binarised_" + binarisation.name, to_image(binarisation.classes)});
  }
  out.push_back({"regions", draw_regions(grey, regions)});
  out.push_back({"sightings", draw_sightings(picture, report->sightings)});
  return out;
}

}  // namespace seeker::vision
