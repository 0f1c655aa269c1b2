#include "server/localize/confidence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace seeker::localize {
namespace {

std::string with_number(const char* format, double number) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), format, number);
  return text.data();
}

}  // namespace

void Confidence::reset() { *this = Confidence(params_); }

double Confidence::mean_nis() const {
  Squares sum;
  for (const Squares& frame : window_) {
    sum.nis += frame.nis;
    sum.inliers += frame.inliers;
  }
  constexpr double kDegreesOfFreedom = 2.0;
  return sum.inliers > 0 ? sum.nis / (kDegreesOfFreedom * sum.inliers) : 0.0;
}

std::string Confidence::reason_to_be_lost(double sigma_m, double sigma_rad) const {
  if (contradicted_ >= params_.contradicted_after) {
    return with_number("%.0f frames in a row show none of the landmarks expected", contradicted_);
  }
  if (weak_ >= params_.lost_after) {
    return with_number("%.0f frames in a row with too few landmarks", weak_);
  }
  if (sigma_m > params_.lost_sigma_m || sigma_rad > params_.lost_sigma_rad) {
    return with_number("the pose is only known to %.2f m after coasting", sigma_m);
  }
  if (mean_nis() > params_.lost_nis) {
    return with_number("landmarks lie where they should not: innovations are %.1f times their expectation", mean_nis());
  }
  return {};
}

void Confidence::judge(const FrameEvidence& frame, double sigma_m, double sigma_rad) {
  const bool corrects = frame.inliers >= params_.min_update_inliers;
  const bool few = frame.inliers < params_.min_inliers;
  weak_ = few ? weak_ + 1 : 0;
  blind_ = corrects ? 0 : blind_ + 1;
  const bool contradicts =
      !corrects && frame.usable && frame.in_range >= params_.plenty && frame.expected >= params_.plenty;
  contradicted_ = contradicts ? contradicted_ + 1 : 0;
  if (corrects) {
    window_.push_back({frame.nis, frame.inliers});
    if (window_.size() > static_cast<std::size_t>(params_.window)) {
      window_.pop_front();
    }
  }
  const double by_inliers = std::min(1.0, static_cast<double>(frame.inliers) / params_.good_inliers);
  const double by_nis = 1.0 / std::max(1.0, mean_nis());
  const double by_sigma = std::clamp(1.0 - sigma_m / params_.lost_sigma_m, 0.0, 1.0);
  value_ = by_inliers * by_nis * by_sigma;
  cause_ = reason_to_be_lost(sigma_m, sigma_rad);
  if (!cause_.empty()) {
    quality_ = LocalisationQuality::kLost;
    value_ = 0.0;
    return;
  }
  if (!frame.usable) {
    cause_ = frame.problem;
  } else if (few) {
    cause_ = with_number("only %.0f landmarks agree; look at more of the surveyed building", frame.inliers);
  } else if (mean_nis() > params_.degraded_nis) {
    cause_ = with_number("innovations are %.1f times their expectation", mean_nis());
  }
  quality_ = cause_.empty() ? LocalisationQuality::kLocalised : LocalisationQuality::kDegraded;
}

}  // namespace seeker::localize
