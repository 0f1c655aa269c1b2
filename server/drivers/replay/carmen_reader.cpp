#include "server/drivers/replay/carmen_reader.hpp"

#include <algorithm>
#include <utility>

#include "server/drivers/replay/scan_csv.hpp"

namespace seeker::drivers {

Result<CarmenReader> CarmenReader::open(const std::filesystem::path& path) {
  Result<LineFile> file = LineFile::open(path);
  if (!file) {
    return tl::unexpected<Error>(file.error());
  }
  return CarmenReader(std::move(*file));
}

void CarmenReader::count_bad(std::string reason) {
  ++summary_.bad;
  if (summary_.examples.size() < BadLines::kMaxExamples) {
    summary_.examples.push_back({summary_.lines, std::move(reason)});
  }
}

void CarmenReader::reject_last(std::string reason) {
  --(last_was_scan_ ? summary_.scans : summary_.odometry);
  count_bad(std::move(reason));
}

std::optional<CarmenRecord> CarmenReader::take(std::string_view line) {
  auto record = parse_log_line(line);
  if (!record) {
    count_bad(record.error().message);
    return std::nullopt;
  }
  if (!*record) {
    ++summary_.ignored;
    if (const auto range_max_m = stated_range_max_m(line)) {
      range_max_m_ = std::min(*range_max_m, range_max_m_.value_or(*range_max_m));
    }
    return std::nullopt;
  }
  last_was_scan_ = std::holds_alternative<CarmenScan>(**record);
  if (last_was_scan_ && range_max_m_) {
    auto& scan = std::get<CarmenScan>(**record);
    scan.range_max_m = scan.range_max_m.value_or(*range_max_m_);
  }
  ++(last_was_scan_ ? summary_.scans : summary_.odometry);
  return std::move(*record);
}

std::optional<CarmenRecord> CarmenReader::next() {
  std::string line;
  while (true) {
    const LineFile::Line read = file_.next(line);
    if (read == LineFile::Line::kEnd) {
      summary_.damage = file_.damage();
      return std::nullopt;
    }
    summary_.lines = file_.number();
    if (read == LineFile::Line::kTooLong) {
      count_bad("the line is longer than " + std::to_string(kMaxLine_bytes) + " bytes");
    } else if (auto record = take(line)) {
      return record;
    }
  }
}

std::string describe(const ReplaySummary& summary) {
  std::string text = "read " + std::to_string(summary.lines) + " lines: " + std::to_string(summary.scans) + " scans, " +
                     std::to_string(summary.odometry) + " odometry records over " +
                     std::to_string(static_cast<int>(summary.duration_s)) + " s, " + std::to_string(summary.ignored) +
                     " ignored, " + std::to_string(summary.bad) + " bad";
  if (!summary.examples.empty()) {
    text += " (first: line " + std::to_string(summary.examples.front().number) + ", " +
            summary.examples.front().reason + ")";
  }
  if (summary.overtaken > 0) {
    text += "; " + std::to_string(summary.overtaken) + " scans were overtaken by newer ones";
  }
  if (!summary.damage.empty()) {
    text += "; the file ends early: " + summary.damage;
  }
  return text;
}

}  // namespace seeker::drivers
