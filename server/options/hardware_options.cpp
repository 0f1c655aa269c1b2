#include "server/options/hardware_options.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace seeker {
namespace {

/// Whole numbers of any type, within that type's range.
template <class Whole>
void describe_whole(config::Fields& f, std::string_view key, Whole& value) {
  auto wide = static_cast<std::uint64_t>(value);
  f.field(key, wide);
  const bool fits = wide <= std::numeric_limits<Whole>::max();
  f.check(key, fits, "is too large");
  value = fits ? static_cast<Whole>(wide) : value;
}

}  // namespace

void describe(config::Fields& f, WheelCalibration& calibration) {
  f.field("track_m", calibration.track_m);
  f.field("left_scale", calibration.left_scale);
  f.field("right_scale", calibration.right_scale);
  f.field("track_scale", calibration.track_scale);
  const Status ok = validate(calibration);
  f.check("track_m", ok.has_value(), ok ? "" : ok.error().message);
}

}  // namespace seeker

namespace seeker::lms200 {

void describe(config::Fields& f, SubRange& range) {
  describe_whole(f, "first", range.first);
  describe_whole(f, "last", range.last);
}

}  // namespace seeker::lms200

namespace seeker::drivers {
namespace {

void describe_rates(config::Fields& f, std::string_view key, std::vector<std::uint32_t>& bauds) {
  constexpr double kHighest = 4e6;
  std::vector<double> rates(bauds.begin(), bauds.end());
  f.field(key, rates);
  const bool valid = !rates.empty() && std::all_of(rates.begin(), rates.end(),
                                                   [](double rate) { return rate >= 1.0 && rate <= kHighest; });
  f.check(key, valid, "must be rates in bits per second");
  if (valid) {
    bauds.clear();
    bauds.reserve(rates.size());
    std::transform(rates.begin(), rates.end(), std::back_inserter(bauds),
                   [](double rate) { return static_cast<std::uint32_t>(rate); });
  }
}

/// A duration that is seconds in code.
void describe_positive(config::Fields& f, std::string_view key, double& value) {
  f.field(key, value);
  f.check(key, value > 0.0, "must be above 0");
}

void describe_timing(config::Fields& f, P2osParams& params) {
  f.seconds("pulse_period_s", params.pulse_period);
  f.seconds("velocity_resend_s", params.velocity_resend);
  f.seconds("command_timeout_s", params.command_timeout);
  f.seconds("sip_timeout_s", params.sip_timeout);
  f.field("sync_tries", params.sync_tries);
  f.seconds("sync_timeout_s", params.sync_timeout);
  f.seconds("restart_pause_s", params.restart_pause);
  f.seconds("close_settle_s", params.close_settle);
  f.seconds("open_timeout_s", params.open_timeout);
  f.seconds("config_retry_s", params.config_retry);
  f.seconds("config_timeout_s", params.config_timeout);
  f.seconds("baud_settle_s", params.baud_settle);
  f.seconds("baud_timeout_s", params.baud_timeout);
}

}  // namespace

void describe(config::Fields& f, P2osParams& params) {
  describe_rates(f, "bauds", params.bauds);
  std::uint64_t switch_to = params.switch_to_baud.value_or(0);
  f.field("switch_to_baud", switch_to);
  params.switch_to_baud = switch_to == 0 ? std::nullopt : std::optional(static_cast<std::uint32_t>(switch_to));
  f.optional_field("subclass", params.subclass);
  f.field("v_max_m_s", params.v_max_m_s);
  f.angle_deg("omega_max_deg_s", params.omega_max_rad_s);
  f.field("acceleration_m_s2", params.acceleration_m_s2);
  f.field("deceleration_m_s2", params.deceleration_m_s2);
  f.angle_deg("angular_acceleration_deg_s2", params.angular_acceleration_rad_s2);
  f.angle_deg("angular_deceleration_deg_s2", params.angular_deceleration_rad_s2);
  f.field("use_sonar", params.use_sonar);
  f.field("use_gyro", params.use_gyro);
  f.field("use_bumpers", params.use_bumpers);
  f.field("use_vel2", params.use_vel2);
  f.field("sonar_range_max_m", params.sonar_range_max_m);
  f.angle_deg("sonar_cone_half_angle_deg", params.sonar_cone_half_angle_rad);
  f.seconds("sonar_max_age_s", params.sonar_max_age);
  describe_timing(f, params);
  f.field("step_margin_m", params.step_margin_m);
  f.angle_deg("step_margin_deg", params.step_margin_rad);
  const Status ok = validate(params);
  f.check("v_max_m_s", ok.has_value(), ok ? "" : ok.error().message);
}

void describe(config::Fields& f, LmsParams& params) {
  describe_whole(f, "baud", params.baud);
  describe_rates(f, "search_bauds", params.search_bauds);
  describe_whole(f, "angle_deg", params.variant.angle_deg);
  constexpr double kCentidegrees = 100.0;  // in a degree
  double resolution_deg = params.variant.resolution_cdeg / kCentidegrees;
  f.field("resolution_deg", resolution_deg);
  constexpr double kCoarsest_deg = 1.0;
  const bool possible = resolution_deg > 0.0 && resolution_deg <= kCoarsest_deg;
  f.check("resolution_deg", possible, "must be 0.25, 0.5 or 1");
  params.variant.resolution_cdeg = possible ? static_cast<std::uint16_t>(std::lround(resolution_deg * kCentidegrees))
                                            : params.variant.resolution_cdeg;
  f.choice("unit", params.unit,
           config::Choices<lms200::Unit>{{"mm", lms200::Unit::kMillimetre}, {"cm", lms200::Unit::kCentimetre}});
  f.choice("measuring_mode", params.measuring_mode,
           config::Choices<lms200::MeasuringMode>{{"8m", lms200::MeasuringMode::k8mFieldsAbDazzle},
                                                  {"8m_reflector", lms200::MeasuringMode::k8mReflector},
                                                  {"16m_reflector", lms200::MeasuringMode::k16mReflector},
                                                  {"16m", lms200::MeasuringMode::k16mFieldsAb},
                                                  {"32m_reflector", lms200::MeasuringMode::k32mReflector},
                                                  {"32m", lms200::MeasuringMode::k32m}});
  f.optional_section("sub_range", params.sub_range);
  f.field("may_write_flash", params.may_write_flash);
  f.field("base_T_laser", params.base_T_laser);
  f.field("range_min_m", params.range_min_m);
  describe_positive(f, "scan_timeout_s", params.scan_timeout_s);
  describe_positive(f, "reply_timeout_s", params.reply_timeout_s);
  describe_positive(f, "mode_timeout_s", params.mode_timeout_s);
  describe_positive(f, "flash_timeout_s", params.flash_timeout_s);
  f.field("baud_settle_s", params.baud_settle_s);
  f.field("retry_pause_s", params.retry_pause_s);
  describe_positive(f, "partial_timeout_s", params.partial_timeout_s);
  f.field("tries", params.tries);
  f.field("search_tries", params.search_tries);
  f.field("rounds", params.rounds);
  f.field("device_latency_s", params.device_latency_s);
  f.field("line_keeps_rate", params.line_keeps_rate);
}

void describe(config::Fields& f, RplidarParams& params) {
  describe_rates(f, "bauds", params.bauds);
  f.choice("scan_mode", params.scan_mode,
           config::Choices<RplidarScanMode>{{"automatic", RplidarScanMode::kAutomatic},
                                            {"express", RplidarScanMode::kExpress},
                                            {"legacy", RplidarScanMode::kLegacy}});
  f.choice("motor", params.motor,
           config::Choices<RplidarMotor>{
               {"automatic", RplidarMotor::kAutomatic}, {"dtr", RplidarMotor::kDtr}, {"pwm", RplidarMotor::kPwm}});
  describe_whole(f, "motor_pwm", params.motor_pwm);
  f.field("base_T_laser", params.base_T_laser);
  f.field("upside_down", params.upside_down);
  f.field("range_min_m", params.range_min_m);
  f.field("range_max_m", params.range_max_m);
  f.angle_deg("angle_step_deg", params.angle_step_rad);
  f.field("least_revolution_share", params.least_revolution_share);
  f.seconds("answer_timeout_s", params.answer_timeout);
  f.field("tries", params.tries);
  f.seconds("stop_pause_s", params.stop_pause);
  f.seconds("boot_time_s", params.boot_time);
  f.seconds("scan_timeout_s", params.scan_timeout);
  f.seconds("revolution_timeout_s", params.revolution_timeout);
  f.field("restarts", params.restarts);
  f.field("resets", params.resets);
}

void describe(config::Fields& f, BaseSettings& settings) {
  f.choice("driver", settings.driver, config::choices_of(kBaseKinds));
  f.field("port", settings.port);
  f.section("p2os", settings.p2os);
}

void describe(config::Fields& f, LidarSettings& settings) {
  f.choice("driver", settings.driver, config::choices_of(kLidarKinds));
  f.field("port", settings.port);
  f.section("lms200", settings.lms200);
  f.section("rplidar", settings.rplidar);
}

void describe(config::Fields& f, HardwareSettings& settings) {
  f.section("base", settings.base);
  f.optional_section("lidar", settings.lidar);
  f.optional_section("second_lidar", settings.second_lidar);
  f.seconds("first_reopen_s", settings.first_reopen);
  f.check("first_reopen_s", settings.first_reopen > Duration::zero(), "must be above 0");
  f.seconds("longest_reopen_s", settings.longest_reopen);
  f.check("longest_reopen_s", settings.longest_reopen >= settings.first_reopen, "must be at least first_reopen_s");
}

}  // namespace seeker::drivers
