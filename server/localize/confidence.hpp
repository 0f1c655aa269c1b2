/// \file
/// Confidence in the pose of a localiser, judged by its frames.
#pragma once

#include <deque>
#include <string>

#include "common/core/pose_estimate.hpp"
#include "server/localize/localiser_params.hpp"

namespace seeker::localize {

/// Evidence of one frame about the pose.
struct FrameEvidence {
  bool usable = true;   ///< false when no features could be extracted
  std::string problem;  ///< cause for a frame that is not usable
  int in_range = 0;
  int expected = 0;
  int inliers = 0;
  double nis = 0.0;
};

/// Applies the rules of ConfidenceParams; remembers the last frames.
class Confidence {
 public:
  explicit Confidence(const ConfidenceParams& params) : params_(params) {}

  /// Starts with an empty memory.
  void reset();
  /// Updates quality and cause by one more frame; `sigma_m` and `sigma_rad` are those of the present pose.
  void judge(const FrameEvidence& frame, double sigma_m, double sigma_rad);

  [[nodiscard]] LocalisationQuality quality() const { return quality_; }
  [[nodiscard]] const std::string& cause() const { return cause_; }
  /// Confidence from 0 to 1.
  [[nodiscard]] double value() const { return value_; }
  /// Number of frames in a row without a correction.
  [[nodiscard]] int blind_frames() const { return blind_; }

 private:
  struct Squares {
    double nis = 0.0;
    int inliers = 0;
  };

  [[nodiscard]] double mean_nis() const;
  /// The cause for LOST; empty when not lost.
  [[nodiscard]] std::string reason_to_be_lost(double sigma_m, double sigma_rad) const;

  ConfidenceParams params_;
  std::deque<Squares> window_;
  int weak_ = 0;  ///< number of frames in a row with few inliers
  int blind_ = 0;
  int contradicted_ = 0;  ///< number of frames in a row in which expected landmarks were not observed
  LocalisationQuality quality_ = LocalisationQuality::kLocalised;
  std::string cause_;
  double value_ = 1.0;
};

}  // namespace seeker::localize
