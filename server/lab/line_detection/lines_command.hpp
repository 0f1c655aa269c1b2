/// \file
/// Command `seeker-lab lines`: the line extractor on a recorded log.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "common/core/result.hpp"
#include "server/drivers/replay/replay.hpp"
#include "server/lab/experiments/log_stopwatch.hpp"
#include "server/lines/make_extractor.hpp"

namespace seeker::lab {

/// Results of the extractor on a log, and its cost.
struct LineStatistics {
  std::string extractor;  ///< name as in the field `lines.extractor` of a robot file
  std::uint64_t scans = 0;
  std::uint64_t beams = 0;  ///< number of beams of the first scan
  std::uint64_t lines = 0;
  double lines_per_scan = 0.0;
  std::uint64_t most_lines = 0;
  double points_on_lines = 0.0;  ///< share of the returns
  double range_sigma_m = 0.0;    ///< noise that the extractor used, median over the scans
  TimeFigures scan;              ///< wall time
  TimeFigures scan_processor;    ///< processor time of the thread
  std::uint64_t bad_lines = 0;   ///< malformed lines of the log's text
};

/// Extracts the lines of every scan. Errors of ReplaySource::open(); kParse when the log has no scan.
[[nodiscard]] Result<LineStatistics> measure_lines(const std::filesystem::path& log,
                                                   const drivers::ReplayParams& geometry,
                                                   const lines::ExtractorParams& params = {});

struct LinesOptions {
  std::filesystem::path log;
  std::filesystem::path robot;
  std::filesystem::path config;
  std::vector<std::string> overrides;
  std::string extractor;              ///< name; empty: the one of the robot file
  std::optional<std::uint64_t> scan;  ///< index of the scan to draw, the first being 0
  std::filesystem::path out;          ///< PNG of that scan
  bool json = false;
};

/// Prints the statistics, or draws one scan. Errors of the files; kNotFound: no such scan.
[[nodiscard]] Status run_lines(const LinesOptions& options, std::ostream& out);

}  // namespace seeker::lab
