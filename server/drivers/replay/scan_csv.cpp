#include "server/drivers/replay/scan_csv.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "common/core/angle.hpp"
#include "common/core/number_in.hpp"
#include "common/core/scan.hpp"

namespace seeker::drivers {
namespace {

constexpr std::string_view kBlank = " \t\r";

/// Fields between commas, blanks around them dropped; unlike words, a field may be empty.
class Fields {
 public:
  explicit Fields(std::string_view text) : rest_(text) {}

  [[nodiscard]] std::optional<std::string_view> next() {
    if (ended_) {
      return std::nullopt;
    }
    const std::size_t comma = rest_.find(',');
    std::string_view field = rest_.substr(0, comma);
    ended_ = comma == std::string_view::npos;
    rest_.remove_prefix(ended_ ? rest_.size() : comma + 1);
    const std::size_t first = std::min(field.find_first_not_of(kBlank), field.size());
    field.remove_prefix(first);
    return field.substr(0, field.find_last_not_of(kBlank) + 1);
  }

 private:
  std::string_view rest_;
  bool ended_ = false;
};

}  // namespace

bool is_scan_csv(std::string_view line) {
  const std::size_t first = line.find_first_not_of(kBlank);
  if (first == std::string_view::npos || std::string_view("0123456789.-").find(line[first]) == std::string_view::npos) {
    return false;
  }
  return line.find(',') != std::string_view::npos;
}

Result<CarmenScan> parse_scan_csv_line(std::string_view line) {
  Fields fields(line);
  const std::optional<double> stamp_s = finite_in(fields.next().value_or(""));
  const std::optional<double> x_m = finite_in(fields.next().value_or(""));
  const std::optional<double> y_m = finite_in(fields.next().value_or(""));
  const std::optional<double> theta_rad = finite_in(fields.next().value_or(""));
  if (!stamp_s || !x_m || !y_m || !theta_rad) {
    return fail(Errc::kParse, "a scan line does not begin with a time and a pose");
  }
  CarmenScan scan;
  scan.stamp_s = *stamp_s;
  scan.odom_T_base = Pose2{*x_m, *y_m, wrap_angle(*theta_rad)};
  while (const std::optional<std::string_view> field = fields.next()) {
    if (scan.ranges_m.size() == kMaxScanBeams) {
      return fail(Errc::kTooLarge, "a scan line has an impossible number of beams");
    }
    const std::size_t colon = field->find(':');
    const std::string_view range_text = field->substr(0, colon);
    const std::optional<double> range_m = number_in<double>(range_text);
    if (!range_text.empty() && !range_m) {
      return fail(Errc::kParse, "a range of a scan line is no number");
    }
    if (colon != std::string_view::npos) {
      const std::optional<double> quality = finite_in(field->substr(colon + 1));
      if (!quality || *quality < 0.0) {
        return fail(Errc::kParse, "a signal quality of a scan line is no number from 0 on");
      }
      scan.strengths.push_back(static_cast<float>(*quality));
    }
    const bool usable = range_m && std::isfinite(*range_m);
    scan.ranges_m.push_back(usable ? static_cast<float>(*range_m) : 0.0F);
  }
  if (scan.ranges_m.empty()) {
    return fail(Errc::kParse, "a scan line has no ranges");
  }
  if (!scan.strengths.empty() && scan.strengths.size() != scan.ranges_m.size()) {
    return fail(Errc::kParse, "a scan line has a signal quality for some of its ranges only");
  }
  return scan;
}

Result<std::optional<CarmenRecord>> parse_log_line(std::string_view line) {
  if (!is_scan_csv(line)) {
    return parse_carmen_line(line);
  }
  Result<CarmenScan> scan = parse_scan_csv_line(line);
  if (!scan) {
    return tl::unexpected<Error>(scan.error());
  }
  return CarmenRecord(std::move(*scan));
}

}  // namespace seeker::drivers
