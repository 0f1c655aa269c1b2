/// \file
/// Streams a log from disk, plain or compressed with gzip: CARMEN records, or scans as numbers with commas.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/core/result.hpp"
#include "server/drivers/replay/carmen_line.hpp"
#include "server/drivers/replay/line_file.hpp"

namespace seeker::drivers {

/// What was read so far.
struct ReplaySummary {
  std::uint64_t lines = 0;
  std::uint64_t odometry = 0;
  std::uint64_t scans = 0;
  std::uint64_t ignored = 0;      ///< comments, PARAM, types not used here
  std::uint64_t bad = 0;          ///< malformed, too long, or with a stamp out of order
  std::uint64_t overtaken = 0;    ///< scans that were replaced by a newer one before anyone read them
  double duration_s = 0.0;        ///< from the first stamp to the last
  std::vector<BadLine> examples;  ///< the first BadLines::kMaxExamples bad lines
  std::string damage;             ///< why the file ended early (cut or damaged compression); empty otherwise
};

/// One or two sentences for people: how much was read and what was skipped.
[[nodiscard]] std::string describe(const ReplaySummary& summary);

/// Reads record after record; bad lines are counted and skipped, memory is bounded by one line.
class CarmenReader {
 public:
  static constexpr std::size_t kMaxLine_bytes = LineFile::kMaxLine_bytes;

  /// kNotFound or kIo with the file named.
  [[nodiscard]] static Result<CarmenReader> open(const std::filesystem::path& path);

  /// The next record; nothing at the end of the file or where damage ends it (see summary().damage).
  [[nodiscard]] std::optional<CarmenRecord> next();
  [[nodiscard]] const ReplaySummary& summary() const { return summary_; }
  /// Counts the line of the record that next() returned last as bad after all (its stamp is out of order).
  void reject_last(std::string reason);
  void note_overtaken() { ++summary_.overtaken; }
  void note_duration(double duration_s) { summary_.duration_s = duration_s; }

 private:
  explicit CarmenReader(LineFile file) : file_(std::move(file)) {}
  [[nodiscard]] std::optional<CarmenRecord> take(std::string_view line);
  void count_bad(std::string reason);

  LineFile file_;
  ReplaySummary summary_;
  bool last_was_scan_ = false;
  std::optional<double> range_max_m_;  ///< the least that a PARAM line stated, for scans that state none themselves
};

}  // namespace seeker::drivers
