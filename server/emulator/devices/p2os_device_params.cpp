#include "server/emulator/devices/p2os_device_params.hpp"

#include <cmath>

#include "server/protocols/p2os/command.hpp"
#include "server/protocols/p2os/pioneer_model.hpp"

namespace seeker::emulator {
namespace {

constexpr std::size_t kMaxTextBytes = 20;
/// The configuration states the period in a byte of milliseconds, the watchdog in two.
constexpr Duration kMaxSipPeriod = std::chrono::milliseconds(255);
constexpr Duration kMaxWatchdog = std::chrono::milliseconds(0xFFFF);
/// A reading is made of each transducer of two arrays at most.
constexpr std::size_t kMaxSonarsPerSip = 2 * p2os::kArraySonars;

bool is_text(const std::string& text) { return text.size() <= kMaxTextBytes && text.find('\0') == std::string::npos; }

bool above_zero(double value) { return std::isfinite(value) && value > 0.0; }

bool valid_limits(const PioneerLimits& l) {
  return above_zero(l.v_max_m_s) && above_zero(l.omega_max_rad_s) && above_zero(l.acceleration_m_s2) &&
         above_zero(l.deceleration_m_s2) && above_zero(l.angular_acceleration_rad_s2) &&
         above_zero(l.angular_deceleration_rad_s2);
}

}  // namespace

Status validate(const P2osDeviceParams& p) {
  const auto refuse = [](const char* what) {
    return fail(Errc::kInvalidArgument, std::string("the emulated base's ") + what);
  };
  if (p2os::find_pioneer_model(p.subclass) == nullptr) {
    return refuse("subclass is not known");
  }
  if (!is_text(p.name) || !is_text(p.serial_number) || !is_text(p.subclass)) {
    return refuse("name, serial number and subclass must be texts of at most 20 bytes");
  }
  if (p.baud != 0 && !p2os::baud_code(p.baud)) {
    return refuse("rate must be 9600, 19200, 38400, 57600 or 115200 baud, or 0 for TCP");
  }
  if (p.sip_period <= Duration{0} || p.sip_period > kMaxSipPeriod || p.watchdog <= Duration{0} ||
      p.watchdog > kMaxWatchdog || p.stall_wait < Duration{0}) {
    return refuse("period must be at most 0.255 s, its watchdog at most 65 s, and both above 0");
  }
  if (p.sonars_per_sip > kMaxSonarsPerSip || !(p.gyro_rest_count > 0.0 && p.gyro_rest_count < p2os::kGyroMaxCount)) {
    return refuse("sonars in a packet must be at most 16, its gyroscope's count at rest between 0 and 1023");
  }
  constexpr double kMaxStep_m = 0.1;
  if (!above_zero(p.v_top_m_s) || !above_zero(p.omega_top_rad_s) ||
      p.v_top_m_s * to_seconds(p.sip_period) >= kMaxStep_m || !valid_limits(p.limits)) {
    return refuse("velocities and accelerations must be above 0, and its way in one period below 0.1 m");
  }
  return {};
}

}  // namespace seeker::emulator
