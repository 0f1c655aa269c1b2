/// \file
/// Whether scans and wheels turn the same way: beams that run in the other direction, a scanner that hangs upside down
/// or wheels that are swapped make a map of a mirrored building, every scan of which fits the one before.
#pragma once

namespace seeker::slam {

struct TurnSenseParams {
  double least_rad = 0.01;  ///< of a turn between two scans, by the wheels: less is noise
  double most_rad = 0.35;   ///< more, and the match may have found another wall
  double enough_rad = 4.0;  ///< of such turns before anything is said
  /// Turn by the scans over that by the wheels, in the mean: as good as 1, and 0 where wheels slip or say nothing.
  double reversed_share = -0.5;
};

class TurnSense {
 public:
  explicit TurnSense(const TurnSenseParams& params = {}) : params_(params) {}

  /// A turn between two scans, as the wheels and as the scans have it.
  void note(double by_wheels_rad, double by_scans_rad);
  [[nodiscard]] bool reversed() const;
  void clear() { *this = TurnSense(params_); }

 private:
  TurnSenseParams params_;
  double turned_rad_ = 0.0;  ///< by the wheels, either way
  double squares_rad2_ = 0.0;
  double products_rad2_ = 0.0;
};

}  // namespace seeker::slam
