/// \file
/// Patches of bounded size cut from a picture at any position and scale, and their correlation (stage 3 of spec S3.4).
/// The candidate is resized to one of few template sizes, so that the cost does not grow with the candidate.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

namespace seeker::vision {

/// A grey picture at full, half, quarter ... resolution (means of 2x2 pixels).
class GreyPyramid {
 public:
  explicit GreyPyramid(const cv::Mat& grey);

  /// Samples columns x rows values at the centres of equal cells of `box` (pixel edges: the picture covers [0, width) x
  /// [0, height)), bilinear in the level in which a cell is one to two pixels; outside the picture the nearest pixel is
  /// used. Row-major.
  void sample(const cv::Rect2d& box, int columns, int rows, std::vector<float>& values) const;

 private:
  std::vector<cv::Mat> levels_;
};

/// A target's picture at one size, ready to be correlated.
class TemplatePatch {
 public:
  /// `grey` and `mask` (CV_8UC1, 0 = pixel does not count; empty: all count) are scaled to columns x rows.
  TemplatePatch(const cv::Mat& grey, const cv::Mat& mask, int columns, int rows);

  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }
  /// Zero-mean NCC with sampled values, -1..1; 0 where their standard deviation is below min_contrast.
  [[nodiscard]] double ncc(const std::vector<float>& values, double min_contrast) const;
  /// The best correlation, by its absolute value, with a plain shape: disc, box, half-plane. A candidate that is more
  /// similar to one of these than to the target is not the target. Shapes that the target itself equals are left out.
  [[nodiscard]] double plain_ncc(const std::vector<float>& values) const;
  /// Correlation of the gradient fields, -1..1: sensitive to displaced or missing edges, insensitive to slow changes of
  /// brightness.
  [[nodiscard]] double gradient_ncc(const std::vector<float>& values) const;

 private:
  struct Gradient {
    std::size_t at = 0;  ///< index of the inner sample
    float x = 0.0F;
    float y = 0.0F;
  };
  void prepare_gradients(const cv::Mat& scaled, const cv::Mat& mask);
  void prepare_plain_shapes();
  [[nodiscard]] bool centre_and_scale(std::vector<float>& values) const;
  [[nodiscard]] double spread(const std::vector<float>& values) const;

  int columns_;
  int rows_;
  std::vector<float> centred_;  ///< zero mean and unit norm over the mask, 0 outside
  std::vector<float> mask_;     ///< 0 or 1
  double mask_count_ = 0.0;
  std::vector<std::vector<float>> plain_shapes_;  ///< normalised like centred_
  std::vector<Gradient> gradients_;               ///< unit norm; inner samples with their four neighbours in the mask
};

}  // namespace seeker::vision
