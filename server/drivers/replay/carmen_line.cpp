#include "server/drivers/replay/carmen_line.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "common/core/angle.hpp"
#include "common/core/scan.hpp"
#include "server/drivers/replay/words.hpp"

namespace seeker::drivers {
namespace {

/// The three words that end each record; the stamp is the first, the host the second.
double read_stamp(Words& words, std::string* host = nullptr) {
  const double stamp_s = words.number();
  const std::string_view name = words.word();
  if (name.empty()) {
    words.fail();
  }
  if (host != nullptr) {
    *host = name;
  }
  words.number();
  return stamp_s;
}

tl::unexpected<Error> malformed(std::string_view type) {
  return fail(Errc::kParse, "a " + std::string(type) + " line is malformed or cut off");
}

/// A count and as many readings; false when the count is impossible.
bool read_ranges(Words& words, std::vector<float>& ranges_m) {
  const double count = words.number();
  if (!words.good() || count < 0.0 || count > static_cast<double>(kMaxScanBeams) || count != std::floor(count)) {
    return false;
  }
  for (int k = 0; k < static_cast<int>(count) && words.good(); ++k) {
    ranges_m.push_back(static_cast<float>(words.range()));
  }
  return true;
}

Result<std::optional<CarmenRecord>> parse_odometry(Words& words) {
  CarmenOdometry odometry;
  odometry.odom_T_base = words.pose();
  odometry.velocity.v_m_s = words.number();
  odometry.velocity.omega_rad_s = words.number();
  words.skip(1);
  odometry.stamp_s = read_stamp(words);
  if (!words.good()) {
    return malformed("ODOM");
  }
  return CarmenRecord(odometry);
}

Result<std::optional<CarmenRecord>> parse_front_laser(Words& words) {
  CarmenScan scan;
  if (!read_ranges(words, scan.ranges_m)) {
    return fail(Errc::kTooLarge, "a FLASER line states an impossible number of beams");
  }
  scan.corrected_T_laser = words.pose();
  scan.odom_T_base = words.pose();
  scan.stamp_s = read_stamp(words, &scan.host);
  if (!words.good()) {
    return malformed("FLASER");
  }
  return CarmenRecord(std::move(scan));
}

/// Converters write steps of one degree, or none, for scanners that they do not know: then the field of view holds.
double settled_step(double step_rad, double field_of_view_rad, std::size_t beams) {
  constexpr double kSteps = 2.0;  // so much a field of view may be off that counts beams, not the steps between them
  if (beams < 2 || !(field_of_view_rad > 0.0) || field_of_view_rad > kTwoPi) {
    return step_rad;
  }
  const double steps = static_cast<double>(beams) - 1.0;
  const bool agree = std::abs(std::abs(step_rad) * steps - field_of_view_rad) <= kSteps * std::abs(step_rad);
  return agree ? step_rad : std::copysign(field_of_view_rad / steps, step_rad);
}

Result<std::optional<CarmenRecord>> parse_stated_laser(Words& words, bool with_robot) {
  constexpr int kAfterRange = 2;  // accuracy and remission mode
  constexpr int kRobotTail = 5;   // tv, rv, forward and side safety distance, turn axis
  CarmenScan scan;
  words.skip(1);  // laser type
  scan.angle_min_rad = words.number();
  const double field_of_view_rad = words.number();
  scan.angle_step_rad = words.number();
  if (const double range_max_m = words.number(); range_max_m > 0.0) {
    scan.range_max_m = range_max_m;
  }
  words.skip(kAfterRange);
  if (!read_ranges(words, scan.ranges_m) || !read_ranges(words, scan.strengths)) {
    return fail(Errc::kTooLarge, "a laser line states an impossible number of beams");
  }
  const bool graded = scan.strengths.size() == scan.ranges_m.size() &&
                      std::any_of(scan.strengths.begin(), scan.strengths.end(), [](float s) { return s > 0.0F; });
  if (!graded) {
    scan.strengths.clear();  // loggers write zeros, or another number of them, for scanners that measure none
  }
  scan.angle_step_rad = settled_step(*scan.angle_step_rad, field_of_view_rad, scan.ranges_m.size());
  if (with_robot) {
    words.pose();  // of the laser: the robot's pose and the configured mount say the same
    scan.odom_T_base = words.pose();
    words.skip(kRobotTail);
  }
  scan.stamp_s = read_stamp(words, &scan.host);
  if (!words.good() || *scan.angle_step_rad == 0.0) {
    return malformed(with_robot ? "ROBOTLASER1" : "RAWLASER1");
  }
  return CarmenRecord(std::move(scan));
}

}  // namespace

double stamp_of(const CarmenRecord& record) {
  return std::visit([](const auto& r) { return r.stamp_s; }, record);
}

std::optional<double> stated_range_max_m(std::string_view line) {
  Words words(line);
  if (words.word() != "PARAM") {
    return std::nullopt;
  }
  const std::string_view name = words.word();
  if (name != "laser_front_laser_max_range" && name != "robot_front_laser_max") {
    return std::nullopt;
  }
  const double range_max_m = words.number();
  return words.good() && range_max_m > 0.0 ? std::optional(range_max_m) : std::nullopt;
}

Result<std::optional<CarmenRecord>> parse_carmen_line(std::string_view line) {
  Words words(line);
  const std::string_view type = words.word();
  if (type == "FLASER") {
    return parse_front_laser(words);
  }
  if (type == "ODOM") {
    return parse_odometry(words);
  }
  if (type == "ROBOTLASER1" || type == "RAWLASER1") {
    return parse_stated_laser(words, type == "ROBOTLASER1");
  }
  // Types are upper-case words; anything else is the rest of a broken line.
  if (type.empty() || type.front() == '#' ||
      type.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") == std::string_view::npos) {
    const bool number_only = !type.empty() && type.find_first_not_of("0123456789") == std::string_view::npos;
    if (!number_only) {
      return std::nullopt;
    }
  }
  return fail(Errc::kParse, "the line starts with no known record type");
}

}  // namespace seeker::drivers
