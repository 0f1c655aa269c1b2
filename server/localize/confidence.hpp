/// \file
/// Whether the pose of a localiser can be believed, from what its frames did.
#pragma once

#include <deque>
#include <string>

#include "common/core/pose_estimate.hpp"
#include "server/localize/localiser_params.hpp"

namespace seeker::localize {

/// What a frame said about the pose.
struct FrameEvidence {
  bool usable = true;   ///< false: no features could be had
  std::string problem;  ///< of a frame that is not usable
  int in_range = 0;
  int expected = 0;
  int inliers = 0;
  double nis = 0.0;
};

/// Rules from ConfidenceParams; remembers the last frames.
class Confidence {
 public:
  explicit Confidence(const ConfidenceParams& params) : params_(params) {}

  /// Starts with an empty memory.
  void reset();
  /// Quality and cause after one more frame; `sigma_m` and `sigma_rad` are those of the pose now.
  void judge(const FrameEvidence& frame, double sigma_m, double sigma_rad);

  [[nodiscard]] LocalisationQuality quality() const { return quality_; }
  [[nodiscard]] const std::string& cause() const { return cause_; }
  /// 0 .. 1.
  [[nodiscard]] double value() const { return value_; }
  /// Frames in a row that corrected nothing.
  [[nodiscard]] int blind_frames() const { return blind_; }

 private:
  struct Squares {
    double nis = 0.0;
    int inliers = 0;
  };

  [[nodiscard]] double mean_nis() const;
  /// Empty: not lost.
  [[nodiscard]] std::string reason_to_be_lost(double sigma_m, double sigma_rad) const;

  ConfidenceParams params_;
  std::deque<Squares> window_;
  int weak_ = 0;  ///< frames in a row with few inliers
  int blind_ = 0;
  int contradicted_ = 0;  ///< frames in a row that should have shown landmarks and did not
  LocalisationQuality quality_ = LocalisationQuality::kLocalised;
  std::string cause_;
  double value_ = 1.0;
};

}  // namespace seeker::localize
