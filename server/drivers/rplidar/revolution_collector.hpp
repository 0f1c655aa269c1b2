/// \file
/// Samples of a scanner that turns, collected into one scan a turn.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "common/core/scan.hpp"
#include "common/core/time.hpp"
#include "server/drivers/rplidar/rplidar_params.hpp"
#include "server/protocols/rplidar/polar_sample.hpp"

namespace seeker::drivers {

/// Puts samples onto an even grid of beams over the whole circle, counter-clockwise in the frame `laser`. A turn ends
/// where the scanner looks straight back, so that the seam lies behind. Turns may have any number of samples; what was
/// lost of one leaves beams without a return.
class RevolutionCollector {
 public:
  /// `params` are valid.
  explicit RevolutionCollector(const RplidarParams& params);

  /// Adds a sample with the time at which it was measured, and returns the turn that it shows to be over. Nothing: the
  /// turn goes on, or too little of it was received.
  [[nodiscard]] std::optional<LaserScan> add(const rplidar::PolarSample& sample, RobotTime measured);
  /// Forgets the turn that has begun: another scan starts.
  void restart();

 private:
  struct Moment {
    double turned_rad = 0.0;  ///< since the scanner looked straight back, [0, 2 pi)
    RobotTime time;
  };
  struct Cell {
    float range_m = kNoReturn;
    std::uint8_t quality = 0;
    double off_centre_rad = kTwoPi;  ///< of the sample that the cell has; 2 pi: it has none
  };

  void begin(const Moment& first);
  void put(const rplidar::PolarSample& sample, double turned_rad);
  [[nodiscard]] std::optional<LaserScan> finish();
  [[nodiscard]] LaserScan to_scan() const;

  RplidarParams params_;
  double step_rad_;
  std::vector<Cell> cells_;
  std::optional<Moment> first_;  ///< of this turn
  Moment last_;
  double seen_rad_ = 0.0;  ///< how much of the turn was received
  std::optional<Duration> usual_revolution_;
};

}  // namespace seeker::drivers
