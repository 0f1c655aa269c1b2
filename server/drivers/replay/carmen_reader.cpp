#include "server/drivers/replay/carmen_reader.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "server/drivers/replay/scan_csv.hpp"

namespace seeker::drivers {
namespace {

bool is_scan(const CarmenRecord& record) { return std::holds_alternative<CarmenScan>(record); }

/// Properties found from the records at the start of a file.
Result<LogTraits> survey(const std::filesystem::path& path) {
  Result<LineFile> file = LineFile::open(path);
  if (!file) {
    return tl::unexpected<Error>(file.error());
  }
  LogSurvey survey;
  std::string line;
  while (!survey.knows_enough()) {
    const LineFile::Line read = file->next(line);
    if (read == LineFile::Line::kEnd) {
      break;
    }
    if (read != LineFile::Line::kGood) {
      continue;
    }
    if (const auto record = parse_log_line(line); record && *record) {
      survey.add(**record);
    }
  }
  return survey.traits();
}

}  // namespace

Result<CarmenReader> CarmenReader::open(const std::filesystem::path& path) {
  const Result<LogTraits> traits = survey(path);
  if (!traits) {
    return tl::unexpected<Error>(traits.error());
  }
  Result<LineFile> file = LineFile::open(path);
  if (!file) {
    return tl::unexpected<Error>(file.error());
  }
  return CarmenReader(std::move(*file), *traits);
}

CarmenReader::CarmenReader(LineFile file, const LogTraits& traits)
    : file_(std::move(file)),
      traits_(traits),
      odometry_order_(traits.odometry_period_s),
      scan_order_(traits.scan_period_s) {
  summary_.invented_period_s = traits.invented_period_s;
  if (traits.invented_period_s) {
    invented_clock_.emplace(*traits.invented_period_s / traits.records_per_scan);
  }
}

void CarmenReader::count_bad(std::uint64_t line, std::string reason) {
  ++summary_.bad;
  // A stamp is judged after the lines behind it were read: in the order of the lines all the same.
  std::vector<BadLine>& examples = summary_.examples;
  const auto behind =
      std::find_if(examples.begin(), examples.end(), [&](const BadLine& bad) { return bad.number > line; });
  examples.insert(behind, {line, std::move(reason)});
  examples.resize(std::min(examples.size(), BadLines::kMaxExamples));
}

void CarmenReader::mend(CarmenScan& scan) const {
  if (!scan.range_max_m) {
    scan.range_max_m = range_max_m_ ? range_max_m_ : traits_.reach_m;
  }
  if (traits_.reach_m) {
    scan.range_max_m = std::min(*scan.range_max_m, *traits_.reach_m);
  }
  if (traits_.scan_poses_stand) {
    scan.odom_T_base.reset();
  }
}

void CarmenReader::take(std::string_view line) {
  auto record = parse_log_line(line);
  if (!record) {
    count_bad(summary_.lines, record.error().message);
    return;
  }
  if (!*record) {
    ++summary_.ignored;
    if (const auto range_max_m = stated_range_max_m(line)) {
      range_max_m_ = std::min(*range_max_m, range_max_m_.value_or(*range_max_m));
    }
    return;
  }
  if (auto* scan = std::get_if<CarmenScan>(&**record)) {
    if (traits_.raw_scans_repeat && !scan->odom_T_base) {
      ++summary_.ignored;
      return;
    }
    mend(*scan);
  }
  waiting_.push_back({std::move(**record), summary_.lines});
}

bool CarmenReader::look_ahead() {
  constexpr std::size_t kEnough = 2 * StampOrder::kLookAhead;  // of both kinds together
  std::string line;
  while (!at_end_ && waiting_.size() < kEnough) {
    const LineFile::Line read = file_.next(line);
    if (read == LineFile::Line::kEnd) {
      summary_.damage = file_.damage();
      at_end_ = true;
      break;
    }
    summary_.lines = file_.number();
    if (read == LineFile::Line::kTooLong) {
      count_bad(summary_.lines, "the line is longer than " + std::to_string(kMaxLine_bytes) + " bytes");
    } else {
      take(line);
    }
  }
  return !waiting_.empty();
}

Result<double> CarmenReader::stamp_for(const CarmenRecord& record) {
  if (invented_clock_) {
    return invented_clock_->place(record);
  }
  const bool scan = is_scan(record);
  std::vector<double> following_s;
  for (const Waiting& next : waiting_) {
    if (is_scan(next.record) == scan && following_s.size() < StampOrder::kLookAhead) {
      following_s.push_back(stamp_of(next.record));
    }
  }
  return (scan ? scan_order_ : odometry_order_).place(stamp_of(record), following_s, offset_s_);
}

bool CarmenReader::place(CarmenRecord& record, std::uint64_t line) {
  const Result<double> stamp_s = stamp_for(record);
  if (!stamp_s) {
    count_bad(line, stamp_s.error().message);
    return false;
  }
  std::visit([&](auto& r) { r.stamp_s = *stamp_s; }, record);
  ++(is_scan(record) ? summary_.scans : summary_.odometry);
  first_s_ = first_s_.value_or(*stamp_s);
  summary_.duration_s = std::max(summary_.duration_s, *stamp_s - *first_s_);
  return true;
}

std::optional<CarmenRecord> CarmenReader::next() {
  while (look_ahead()) {
    Waiting first = std::move(waiting_.front());
    waiting_.pop_front();
    if (place(first.record, first.line)) {
      return std::move(first.record);
    }
  }
  return std::nullopt;
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
  if (summary.invented_period_s) {
    text += "; its stamps are too coarse to show when records were made: scans are assumed to be " +
            std::to_string(static_cast<int>(std::lround(1e3 * *summary.invented_period_s))) +
            " ms apart, and more where the robot moved far, so no time or speed of it is real";
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
