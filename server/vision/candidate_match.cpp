#include "server/vision/candidate_match.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace seeker::vision {
namespace {

/// Share of the acceptance threshold that the coarse search must reach, at its best and before any jitter.
constexpr double kPromising = 0.75;
constexpr double kHopeless = 0.25;
constexpr double kFirstStep = 0.04;  // of the box's side
constexpr int kRefinements = 3;

class Correlator {
 public:
  Correlator(const GreyPyramid& scene, double min_contrast) : scene_(scene), min_contrast_(min_contrast) {}

  double ncc(const TemplatePatch& patch, const cv::Rect2d& box) {
    scene_.sample(box, patch.columns(), patch.rows(), values_);
    return patch.ncc(values_, min_contrast_);
  }
  /// The patch under the box.
  const std::vector<float>& values(const TemplatePatch& patch, const cv::Rect2d& box) {
    scene_.sample(box, patch.columns(), patch.rows(), values_);
    return values_;
  }

 private:
  const GreyPyramid& scene_;
  double min_contrast_;
  std::vector<float> values_;
};

cv::Rect2d moved(const cv::Rect2d& box, double dx, double dy, double scale_x, double scale_y) {
  const double width = box.width * scale_x;
  const double height = box.height * scale_y;
  return {box.x + dx + 0.5 * (box.width - width), box.y + dy + 0.5 * (box.height - height), width, height};
}

/// Best of the jitter grid.
void search_grid(Correlator& correlator, const TemplatePatch& patch, const cv::Rect2d& supposed,
                 const TemplateParams& params, cv::Rect2d& best_box, double& best) {
  for (const double scale : {1.0, 1.0 - params.scale_jitter, 1.0 + params.scale_jitter}) {
    for (const double dy : {0.0, -params.position_jitter_px, params.position_jitter_px}) {
      for (const double dx : {0.0, -params.position_jitter_px, params.position_jitter_px}) {
        const cv::Rect2d box = moved(supposed, dx, dy, scale, scale);
        const double score = correlator.ncc(patch, box);
        if (score > best) {
          best = score;
          best_box = box;
        }
      }
    }
  }
}

/// Steps along place and size, one at a time, while they help; then half the step.
void refine(Correlator& correlator, const TemplatePatch& patch, cv::Rect2d& box, double& best) {
  struct Step {
    double x, y, width, height;
  };
  constexpr std::array<Step, 8> kSteps = {{{1, 0, 0, 0},
                                           {-1, 0, 0, 0},
                                           {0, 1, 0, 0},
                                           {0, -1, 0, 0},
                                           {0, 0, 1, 0},
                                           {0, 0, -1, 0},
                                           {0, 0, 0, 1},
                                           {0, 0, 0, -1}}};
  double step = kFirstStep;
  for (int i = 0; i < kRefinements; ++i, step *= 0.5) {
    for (const Step& s : kSteps) {
      const cv::Rect2d next = moved(box, s.x * step * box.width, s.y * step * box.height, 1.0 + 2.0 * s.width * step,
                                    1.0 + 2.0 * s.height * step);
      const double score = correlator.ncc(patch, next);
      if (score > best) {
        best = score;
        box = next;
      }
    }
  }
}

/// Between the two parameters, by the size of the patch.
double gradient_threshold(const TemplateVariant& variant, const TemplatePatch& patch, const TemplateParams& params) {
  const auto side = [](const TemplatePatch& p) { return static_cast<double>(std::max(p.columns(), p.rows())); };
  const double smallest = side(variant.patches.front());
  const double largest = side(variant.patches.back());
  const double share = largest > smallest ? (side(patch) - smallest) / (largest - smallest) : 1.0;
  return params.accept_gradient_ncc + share * (params.accept_gradient_ncc_large - params.accept_gradient_ncc);
}

}  // namespace

CandidateMatch match_candidate(const GreyPyramid& scene, const TemplateVariant& variant, const cv::Rect2d& supposed,
                               const TemplateParams& params) {
  Correlator correlator(scene, params.min_contrast);
  CandidateMatch match{MatchOutcome::kRejectedNcc, supposed, 0.0, 0.0};
  const TemplatePatch& coarse = variant.patches.front();
  match.ncc = correlator.ncc(coarse, supposed);
  if (match.ncc < kHopeless * params.accept_ncc) {
    return match;
  }
  search_grid(correlator, coarse, supposed, params, match.box, match.ncc);
  if (match.ncc < kPromising * params.accept_ncc) {
    return match;
  }
  const TemplatePatch& fine = variant.patch_for(match.box);
  match.ncc = correlator.ncc(fine, match.box);
  if (params.refine) {
    refine(correlator, fine, match.box, match.ncc);
  }
  if (match.ncc < params.accept_ncc) {
    return match;
  }
  const std::vector<float>& values = correlator.values(fine, match.box);
  match.gradient_ncc = fine.gradient_ncc(values);
  const double threshold = gradient_threshold(variant, fine, params);
  const bool verified = (threshold <= 0.0 || match.gradient_ncc >= threshold) &&
                        match.ncc >= fine.plain_ncc(values) + params.plain_shape_margin;
  match.outcome = verified ? MatchOutcome::kAccepted : MatchOutcome::kRejectedVerify;
  return match;
}

}  // namespace seeker::vision
