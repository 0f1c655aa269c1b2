/// \file
/// Streams a log from disk, plain or compressed with gzip: CARMEN records, or scans as comma-separated numbers.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/result.hpp"
#include "server/drivers/replay/carmen_line.hpp"
#include "server/drivers/replay/invented_clock.hpp"
#include "server/drivers/replay/line_file.hpp"
#include "server/drivers/replay/log_survey.hpp"
#include "server/drivers/replay/stamp_order.hpp"

namespace seeker::drivers {

/// Statistics of what was read so far.
struct ReplaySummary {
  std::uint64_t lines = 0;
  std::uint64_t odometry = 0;
  std::uint64_t scans = 0;
  std::uint64_t ignored = 0;    ///< comments, PARAM, types not used here, scans written a second time
  std::uint64_t bad = 0;        ///< malformed, too long, or with a stamp out of order
  std::uint64_t overtaken = 0;  ///< scans that were replaced by a newer one before they were read
  double duration_s = 0.0;      ///< from the first stamp to the last
  /// Assumed time from scan to scan where the log's own stamps are too coarse. Nothing: the stamps are used.
  std::optional<double> invented_period_s;
  std::vector<BadLine> examples;  ///< the first BadLines::kMaxExamples bad lines
  std::string damage;             ///< why the file ended early (cut or damaged compression); empty otherwise
};

/// One or two sentences for people: how much was read, and what was skipped.
[[nodiscard]] std::string describe(const ReplaySummary& summary);

/// Reads record after record. Bad lines are counted and skipped, and memory is bounded by a few lines. Missing or wrong
/// statements of the log are corrected as far as the log itself allows (LogTraits, StampOrder), so that the stamps of
/// each kind only rise.
class CarmenReader {
 public:
  static constexpr std::size_t kMaxLine_bytes = LineFile::kMaxLine_bytes;

  /// Opens a log. Errors: kNotFound or kIo, which name the file.
  [[nodiscard]] static Result<CarmenReader> open(const std::filesystem::path& path);

  /// The next record. Nothing: the end of the file, or damage that ends it (see summary().damage).
  [[nodiscard]] std::optional<CarmenRecord> next();
  [[nodiscard]] const ReplaySummary& summary() const { return summary_; }
  void note_overtaken() { ++summary_.overtaken; }

 private:
  struct Waiting {
    CarmenRecord record;
    std::uint64_t line = 0;
  };

  CarmenReader(LineFile file, const LogTraits& traits);
  /// Reads lines until as many records wait as are needed to judge the first; false where none waits at the end.
  [[nodiscard]] bool look_ahead();
  void take(std::string_view line);
  void mend(CarmenScan& scan) const;
  /// Places a record in time and counts it; false where its stamp is wrong.
  [[nodiscard]] bool place(CarmenRecord& record, std::uint64_t line);
  [[nodiscard]] Result<double> stamp_for(const CarmenRecord& record);
  void count_bad(std::uint64_t line, std::string reason);

  LineFile file_;
  LogTraits traits_;
  ReplaySummary summary_;
  std::deque<Waiting> waiting_;
  bool at_end_ = false;
  std::optional<InventedClock> invented_clock_;  ///< used where the stamps do not show when a record was made
  StampOrder odometry_order_;
  StampOrder scan_order_;
  double offset_s_ = 0.0;          ///< offset from the log's clock to one that was never set
  std::optional<double> first_s_;  ///< stamp of the first record
  /// The smallest range stated by a PARAM line, for scans that state none themselves.
  std::optional<double> range_max_m_;
};

}  // namespace seeker::drivers
