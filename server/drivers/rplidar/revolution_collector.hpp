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
/// where the scanner looks straight back, so that the seam lies behind. Turns may have any number of samples: a beam
/// between two successive returns from one surface has the range of the straight line through both, another one that
/// of the sample nearest to its middle. What was lost of a turn leaves beams without a return.
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
  /// A sample on the grid.
  struct Seen {
    double along_rad = 0.0;  ///< from the first beam's edge, counter-clockwise
    float range_m = kNoReturn;
    std::uint8_t quality = 0;
  };

  void put(const rplidar::PolarSample& sample, double turned_rad);
  void put_nearest(const Seen& seen);
  /// Fills the beams between two returns that follow each other.
  void join(const Seen& one, const Seen& other);
  [[nodiscard]] std::optional<LaserScan> finish();
  [[nodiscard]] LaserScan to_scan() const;

  RplidarParams params_;
  double step_rad_;
  std::vector<Cell> cells_;
  std::optional<Moment> first_;  ///< of this turn
  Moment last_;
  std::optional<Seen> last_return_;  ///< of the sample before
  double seen_rad_ = 0.0;            ///< how much of the turn was received
  std::optional<Duration> usual_revolution_;
};

}  // namespace seeker::drivers
