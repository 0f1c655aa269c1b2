/// \file
/// Checks whether scans and wheels rotate in the same sense: a reversed order of the beams, a scanner mounted upside
/// down or swapped wheels give a map of a mirrored building, although every scan fits the one before.
#pragma once

namespace seeker::slam {

struct RotationSenseParams {
  double least_rad = 0.01;  ///< smallest rotation between two scans, by the wheels, that is above the noise
  double most_rad = 0.35;   ///< largest rotation between two scans for which the match is reliable
  double enough_rad = 4.0;  ///< total of these rotations before a decision is made
  /// Regression coefficient of the rotation by the scans on that by the wheels, below which the sense is reversed: it
  /// is about 1 normally, and 0 where wheels slip or do not move.
  double reversed_share = -0.5;
};

class RotationSense {
 public:
  explicit RotationSense(const RotationSenseParams& params = {}) : params_(params) {}

  /// Adds the rotation between two scans, as measured by the wheels and by the scans.
  void note(double by_wheels_rad, double by_scans_rad);
  [[nodiscard]] bool reversed() const;
  void clear() { *this = RotationSense(params_); }

 private:
  RotationSenseParams params_;
  double rotated_rad_ = 0.0;  ///< by the wheels, in either direction
  double squares_rad2_ = 0.0;
  double products_rad2_ = 0.0;
};

}  // namespace seeker::slam
