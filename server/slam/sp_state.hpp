/// \file
/// The state of an SpMap, for the functions that work on it.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "server/slam/sp_map.hpp"
#include "server/slam/sp_rows.hpp"

namespace seeker::slam {

/// Data of a segment that only the filter needs; parallel to SpState::segments.
struct SegmentRecord {
  Index at = 0;                                         ///< index of its first row in the covariance
  std::array<int, 2> real_votes{};                      ///< consecutive observations of this virtual end as a real one
  std::array<int, 2> overrun_votes{};                   ///< consecutive observations beyond this real end
  std::array<std::optional<double>, 2> end_used_rad{};  ///< bearing in `base` of this end when it was used last
};

/// A new observation that waits for confirmation (spec S1.8).
struct Tentative {
  Pose2 map_T_segment;
  double length_m = 0.0;
  int scans = 1;
};

/// Reused memory of a step, which avoids heap allocations.
class Scratch {
 public:
  [[nodiscard]] Eigen::Map<Eigen::MatrixXd> matrix(Index rows, Index columns) {
    const auto needed = static_cast<std::size_t>(rows * columns);
    if (values_.size() < needed) {
      values_.resize(needed + needed / 2);
    }
    return {values_.data(), rows, columns};
  }

 private:
  std::vector<double> values_;
};

struct SpState {
  SpMapParams params;
  Pose2 map_T_base;
  SpCovariance p;
  std::vector<SpSegment> segments;  ///< by id
  std::vector<SegmentRecord> records;
  std::vector<Tentative> tentatives;
  Observability observability;
  std::uint64_t scans = 0;
  SegmentId next_id = 1;
  std::array<Scratch, 3> scratch;   ///< P H^T, the robot's columns, a segment's columns
  std::vector<CentringStep> steps;  ///< reused memory of centring

  SpState(const SpMapParams& map_params, const Pose2& start, const Matrix3& covariance)
      : params(map_params), map_T_base(start), p(covariance) {}

  [[nodiscard]] std::optional<std::size_t> index_of(SegmentId id) const;
  [[nodiscard]] SegmentRows rows_of(std::size_t segment) const { return {records[segment].at, segments[segment].real}; }
  /// The present bearing of the end in `base`.
  [[nodiscard]] double end_bearing_rad(std::size_t segment, std::size_t side) const;
  /// Whether the end is observed by other beams than when it was used last: SpMapParams::end_beams.
  [[nodiscard]] bool is_end_news(std::size_t segment, std::size_t side, double beam_step_rad) const;
  void note_end_used(std::size_t segment, std::size_t side);
  /// Shifts the row indices of all segments from `first` on.
  void shift_rows(std::size_t first, Index by);
  void erase(std::size_t segment);
};

/// False when the observation is not finite, has no length or an invalid covariance.
[[nodiscard]] bool is_usable(const lines::SegmentObservation& observation);

}  // namespace seeker::slam
