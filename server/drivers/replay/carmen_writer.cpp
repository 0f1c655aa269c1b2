#include "server/drivers/replay/carmen_writer.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "common/core/angle.hpp"

namespace seeker::drivers {
namespace {

constexpr const char* kHost = "seeker";
constexpr int kUnknownLaser = 99;          // as CARMEN calls scanners that it does not know
constexpr double kLaserAccuracy_m = 0.01;  // the format asks for one; no reader of ours uses it
constexpr int kUnusedRobotFields = 3;      // safety distances ahead and to the side, turn axis

/// One line, word by word.
class Line {
 public:
  explicit Line(const char* type) : text_(type) {}

  template <class Number>
  Line& add(Number value) {
    std::array<char, 32> digits{};
    const std::to_chars_result end = std::to_chars(digits.data(), digits.data() + digits.size(), value);
    return add_word({digits.data(), end.ptr});
  }
  Line& add(const Pose2& pose) { return add(pose.x_m).add(pose.y_m).add(pose.theta_rad); }
  Line& end(const LogStamp& stamp) { return add_time(stamp.stamp_s).add_word(kHost).add_time(stamp.since_start_s); }
  [[nodiscard]] std::string text() const { return text_ + "\n"; }

 private:
  Line& add_word(std::string_view word) {
    text_ += ' ';
    text_ += word;
    return *this;
  }
  Line& add_time(double time_s) {
    constexpr int kMicroseconds = 6;
    std::array<char, 64> digits{};
    const std::to_chars_result end =
        std::to_chars(digits.data(), digits.data() + digits.size(), time_s, std::chars_format::fixed, kMicroseconds);
    return add_word({digits.data(), end.ptr});
  }

  std::string text_;
};

bool is_usable(const LaserScan& scan, std::size_t beam) { return scan.quality.empty() || scan.quality[beam] > 0; }

void add_ranges(Line& line, const LaserScan& scan, double no_return_m) {
  line.add(scan.ranges_m.size());
  for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
    const float range_m = scan.ranges_m[beam];
    if (!is_usable(scan, beam)) {
      line.add(0);
    } else if (std::isfinite(range_m)) {
      line.add(range_m);
    } else {
      line.add(no_return_m);
    }
  }
}

}  // namespace

std::string carmen_header(const std::string& robot_id) {
  return "# CARMEN log of " + robot_id +
         ", recorded by Seeker\n"
         "# message_name [message contents] ipc_timestamp ipc_hostname logger_timestamp\n";
}

std::string carmen_mount_comment(const Pose2& base_T_laser) {
  return Line("# base_T_laser (x m, y m, heading deg; for replay.laser.base_T_laser of a robot file):")
      .add(Pose2{base_T_laser.x_m, base_T_laser.y_m, rad_to_deg(base_T_laser.theta_rad)})
      .text();
}

std::string carmen_odometry_line(const CarmenOdometry& odometry, const LogStamp& stamp) {
  constexpr double kAcceleration_m_s2 = 0.0;  // not measured
  return Line("ODOM")
      .add(odometry.odom_T_base)
      .add(odometry.velocity.v_m_s)
      .add(odometry.velocity.omega_rad_s)
      .add(kAcceleration_m_s2)
      .end(stamp)
      .text();
}

std::string carmen_scan_line(const LaserScan& scan, const Pose2& odom_T_base, const Twist2& velocity,
                             const LogStamp& stamp) {
  const bool limited = std::isfinite(scan.range_max_m) && scan.range_max_m > 0.0;
  const double steps = scan.ranges_m.empty() ? 0.0 : static_cast<double>(scan.ranges_m.size()) - 1.0;
  Line line("ROBOTLASER1");
  line.add(kUnknownLaser).add(scan.angle_min_rad).add(steps * std::abs(scan.angle_step_rad)).add(scan.angle_step_rad);
  line.add(limited ? scan.range_max_m : 0.0).add(kLaserAccuracy_m).add(scan.quality.empty() ? 0 : 1);
  add_ranges(line, scan, limited ? scan.range_max_m : kCarmenNoReturn_m);
  line.add(scan.quality.size());
  for (const std::uint8_t quality : scan.quality) {
    line.add(static_cast<int>(quality));
  }
  line.add(odom_T_base * scan.base_T_laser).add(odom_T_base).add(velocity.v_m_s).add(velocity.omega_rad_s);
  for (int k = 0; k < kUnusedRobotFields; ++k) {
    line.add(0);
  }
  return line.end(stamp).text();
}

}  // namespace seeker::drivers
