/// \file
/// The relation metric of Kuemmerle et al., "On measuring the accuracy of SLAM algorithms", Autonomous Robots 27(4),
/// 2009: hand-checked motions between pairs of times, compared with those of a trajectory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/pose2.hpp"
#include "common/core/result.hpp"
#include "server/drivers/replay/line_file.hpp"
#include "server/lab/scoring/trajectory.hpp"

namespace seeker::lab {

/// The true motion of the base between two times, on the relations' own clock.
struct Relation {
  double from_s = 0.0;
  double to_s = 0.0;
  Pose2 from_T_to;
};

/// Parses `t1 t2 dx dy dz roll pitch yaw`. Nothing: an empty line or a comment. kParse: malformed.
[[nodiscard]] Result<std::optional<Relation>> parse_relation_line(std::string_view line);

struct RelationFile {
  std::vector<Relation> relations;
  drivers::BadLines bad;
  std::string damage;  ///< why the file ended early; empty otherwise
};

/// Reads a file, plain or .gz. kNotFound, kIo; kParse when it holds no relation.
[[nodiscard]] Result<RelationFile> read_relations(const std::filesystem::path& path);

struct RelationParams {
  double offset_s = 0.0;   ///< relations' clock minus log's clock
  double max_gap_s = 0.5;  ///< a relation is missed when one of its times has no pose within this time
  /// Relations with both times this near to an exactly stamped scan form the subset `exact`.
  double exact_within_s = 0.12;
};

/// Mean, spread and maximum of one error.
struct ErrorFigures {
  double mean = 0.0;
  double standard_deviation = 0.0;
  double median = 0.0;
  double max = 0.0;
};

struct RelationScore {
  std::uint64_t used = 0;
  ErrorFigures translation_m;
  ErrorFigures rotation_deg;
};

struct RelationReport {
  RelationScore all;
  std::optional<RelationScore> exact;  ///< set where the log states which of its stamps are exact
  std::uint64_t missed = 0;            ///< number of relations outside the trajectory, or with no pose near enough
};

/// Scores the trajectory. Poses at times between its own are computed from the last one by `odometry` (empty:
/// interpolated). `exact_stamps_s`: rising stamps of the scans with exact stamps; may be empty. kInvalidArgument: no
/// relation falls into the trajectory, because the clocks do not fit.
[[nodiscard]] Result<RelationReport> score_relations(const Trajectory& trajectory, const Trajectory& odometry,
                                                     const std::vector<Relation>& relations,
                                                     const std::vector<double>& exact_stamps_s,
                                                     const RelationParams& params = {});

/// Figures of a list; zeros for an empty one.
[[nodiscard]] ErrorFigures figures_of(std::vector<double> errors);

}  // namespace seeker::lab
