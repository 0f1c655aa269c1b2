#include "server/drivers/emulator/emulator_wire.hpp"

#include "common/wire/convert.hpp"

namespace seeker::drivers {

void write(const OdometrySample& from, v1::EmulatorOdometry* to) {
  to->set_stamp_ns(from.stamp.time_since_epoch().count());
  wire::write(from.odom_T_base, to->mutable_odom_t_base());
  wire::write(from.velocity, to->mutable_velocity());
  to->set_battery_v(from.battery_v.value_or(0.0));
  to->set_motors_enabled(from.motors_enabled);
  to->set_stalled(from.stalled);
  to->set_bumped(from.bumped);
}

void read(const v1::EmulatorOdometry& from, OdometrySample& to, wire::Check& check) {
  to.stamp = RobotTime(Duration(from.stamp_ns()));
  wire::read_required(from.has_odom_t_base(), from.odom_t_base(), to.odom_T_base, "odom_t_base", check);
  wire::read_required(from.has_velocity(), from.velocity(), to.velocity, "velocity", check);
  to.battery_v = check.finite("battery_v", from.battery_v());
  to.motors_enabled = from.motors_enabled();
  to.stalled = from.stalled();
  to.bumped = from.bumped();
}

void write(const StereoGeometry& from, v1::EmulatorStereoGeometry* to) {
  to->set_width_px(static_cast<std::uint32_t>(from.width_px));
  to->set_height_px(static_cast<std::uint32_t>(from.height_px));
  to->set_focal_px(from.focal_px);
  to->set_centre_u_px(from.centre_u_px);
  to->set_centre_v_px(from.centre_v_px);
  to->set_baseline_m(from.baseline_m);
}

void read(const v1::EmulatorStereoGeometry& from, StereoGeometry& to, wire::Check& check) {
  to.width_px = check.natural("width_px", from.width_px());
  to.height_px = check.natural("height_px", from.height_px());
  to.focal_px = check.finite("focal_px", from.focal_px());
  to.centre_u_px = check.finite("centre_u_px", from.centre_u_px());
  to.centre_v_px = check.finite("centre_v_px", from.centre_v_px());
  to.baseline_m = check.finite("baseline_m", from.baseline_m());
  if (const Status valid = validate(to); check.ok() && !valid) {
    check.refuse("stereo", valid.error().code, "is refused: " + valid.error().message);
  }
}

}  // namespace seeker::drivers
