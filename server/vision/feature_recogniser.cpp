#include "server/vision/feature_recogniser.hpp"

#include <algorithm>
#include <string>

#include "server/vision/feature_match.hpp"
#include "server/vision/homography.hpp"
#include "server/vision/overlap.hpp"
#include "server/vision/picture.hpp"
#include "server/vision/stage_pictures.hpp"

namespace seeker::vision {
namespace {

DetectorParams detector_of(const FeatureParams& params) {
  DetectorParams detector;
  detector.wanted = params.wanted_features;
  detector.at_most = params.max_features;
  detector.contrast_threshold = params.contrast_threshold;
  return detector;
}

cv::Point2f point_of(const Keypoint& key) { return {key.u_px, key.v_px}; }

std::vector<cv::Point2f> points_of(const FeatureList& features) {
  std::vector<cv::Point2f> points(features.size());
  std::transform(features.keypoints.begin(), features.keypoints.end(), points.begin(), point_of);
  return points;
}

}  // namespace

Result<std::unique_ptr<FeatureRecogniser>> FeatureRecogniser::make(const std::vector<TargetModel>& targets,
                                                                   const RecogniserParams& params) {
  std::unique_ptr<FeatureRecogniser> made(new FeatureRecogniser(params));
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (targets[i].kind != TargetKind::kFeature) {
      continue;
    }
    const cv::Mat grey = to_grey_mat(targets[i].picture);
    Known known{static_cast<int>(i), targets[i].height_m, grey.size(), detect_sift(grey, detector_of(params.features))};
    if (static_cast<int>(known.features.size()) < params.features.min_inliers) {
      return fail(Errc::kInvalidArgument,
                  "target '" + targets[i].name + "': its picture has only " + std::to_string(known.features.size()) +
                      " key points, at least " + std::to_string(params.features.min_inliers) +
                      " are needed: give a larger or more textured picture, or recognise it as a template");
    }
    made->targets_.push_back(std::move(known));
  }
  return made;
}

void FeatureRecogniser::match_target(const Known& known, const FeatureList& scene, const cv::Size& working,
                                     RecognitionReport& report) const {
  const std::vector<FeatureMatch> matches =
      match_mutually(known.features.descriptors, scene.descriptors, {.max_ratio = params_.features.ratio});
  report.stages.matches += static_cast<int>(matches.size());
  ++report.stages.candidates;
  std::vector<cv::Point2f> from;
  std::vector<cv::Point2f> to;
  for (const FeatureMatch& match : matches) {
    from.push_back(point_of(known.features.keypoints[static_cast<std::size_t>(match.first)]));
    to.push_back(point_of(scene.keypoints[static_cast<std::size_t>(match.second)]));
  }
  const auto fit = fit_planar(from, to, known.size, params_.features);
  if (!fit) {
    ++report.stages.rejected_geometry;
    return;
  }
  Sighting sighting;
  sighting.target = known.target;
  sighting.score = static_cast<double>(fit->inliers.size()) / static_cast<double>(matches.size());
  sighting.verify_score = static_cast<double>(fit->inliers.size());
  view_.locate(fit->corners, working, known.height_m, sighting);
  report.sightings.push_back(sighting);
}

Result<RecognitionReport> FeatureRecogniser::recognise(const Image& picture) const {
  const Result<cv::Mat> grey = view_.working_picture(picture);
  if (!grey) {
    return tl::unexpected<Error>(grey.error());
  }
  RecognitionReport report;
  const FeatureList scene = detect_sift(*grey, detector_of(params_.features));
  report.stages.features = static_cast<int>(scene.size());
  for (const Known& known : targets_) {
    match_target(known, scene, grey->size(), report);
  }
  report.stages.rejected_overlap = suppress_overlaps(report.sightings);
  report.stages.accepted = static_cast<int>(report.sightings.size());
  return report;
}

Result<std::vector<StageImage>> FeatureRecogniser::explain(const Image& picture) const {
  const Result<RecognitionReport> report = recognise(picture);
  if (!report) {
    return tl::unexpected<Error>(report.error());
  }
  const cv::Mat grey = *view_.working_picture(picture);
  std::vector<StageImage> out;
  out.push_back({"feature_points", draw_points(grey, points_of(detect_sift(grey, detector_of(params_.features))))});
  out.push_back({"feature_sightings", draw_sightings(picture, report->sightings)});
  return out;
}

}  // namespace seeker::vision
