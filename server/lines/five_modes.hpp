/// \file
/// The state machine of the paper's line detector on one packet of points (spec S5.3).
#pragma once

#include <cstdint>
#include <vector>

#include "server/lines/paper_extractor.hpp"
#include "server/lines/point_row.hpp"

namespace seeker::lines {

/// State of the machine. The paper speaks of four modes and names five.
enum class LineMode : std::uint8_t { kContinuousLine, kSegmentConfirm, kExpand, kCorner, kSplit };

/// Limits of one round for one packet.
struct ModeLimits {
  LineThresholds thresholds;
  double max_fit_error_m = 0.0;
  double spacing_rad = 0.0;  ///< the gap is at least this times the range
};

/// Walks over the points first..last of a row and collects segments.
class FiveModes {
 public:
  FiveModes(const PointRow& row, const PaperParams& params, const ModeLimits& limits)
      : row_(row), params_(params), limits_(limits) {}

  [[nodiscard]] std::vector<Indices> run(std::size_t first, std::size_t last);

 private:
  [[nodiscard]] LineMode continuous_line();
  [[nodiscard]] LineMode segment_confirm();
  [[nodiscard]] LineMode expand();
  [[nodiscard]] LineMode corner();
  [[nodiscard]] LineMode split();
  void close();
  [[nodiscard]] bool is_gap(std::size_t i) const;
  [[nodiscard]] double distance_m(std::size_t i) const;

  const PointRow& row_;
  const PaperParams& params_;
  const ModeLimits& limits_;
  std::size_t next_ = 0;  ///< first point that has not been processed
  std::size_t end_ = 0;   ///< index behind the packet
  Indices segment_;       ///< points of the seed, and later of the line
  Moments sums_;
  LineFit fit_;
  bool confirmed_ = false;
  std::vector<Indices> segments_;
};

}  // namespace seeker::lines
