#include "server/drivers/lms200/scan_maker.hpp"

#include <algorithm>
#include <string>

#include "common/core/angle.hpp"
#include "server/protocols/lms200/telegram.hpp"

namespace seeker::drivers {
namespace {

/// Index in the whole scan of the middle of the values that are sent.
double middle_beam(const LmsParams& params) {
  const double first = params.sub_range ? params.sub_range->first - 1.0 : 0.0;
  return first + (static_cast<double>(beams_of(params)) - 1.0) / 2.0;
}

double latency_s(const LmsParams& params) {
  const double field_s = ScanMaker::kMirrorPeriod_s * deg_to_rad(params.variant.angle_deg) / kTwoPi;
  const double scan_s = (params.variant.mirror_rotations() - 1) * ScanMaker::kMirrorPeriod_s + field_s;
  const double off_middle_rad = params.variant.angle_min_rad() + middle_beam(params) * params.variant.angle_step_rad();
  const double byte_s = to_seconds(lms200::transfer_time(1, params.baud));
  return scan_s / 2.0 - ScanMaker::kMirrorPeriod_s * off_middle_rad / kTwoPi + params.device_latency_s + byte_s;
}

ScanClockParams clock_params(const LmsParams& params) {
  ScanClockParams clock;
  clock.period_s = params.variant.mirror_rotations() * ScanMaker::kMirrorPeriod_s;
  return clock;
}

}  // namespace

ScanMaker::ScanMaker(const LmsParams& params)
    : params_(params), clock_(clock_params(params)), latency_(seconds(latency_s(params))) {}

Status ScanMaker::check(const lms200::ScanTelegram& telegram) const {
  if (telegram.partial) {
    return fail(Errc::kParse, "the scan is a partial one, which was not asked for");
  }
  if (telegram.sub_range != params_.sub_range) {
    return fail(Errc::kParse, "the scan has another sub-range than was asked for");
  }
  if (telegram.words.size() != beams_of(params_)) {
    return fail(Errc::kParse, "the scan has " + std::to_string(telegram.words.size()) + " values instead of " +
                                  std::to_string(beams_of(params_)));
  }
  return {};
}

Result<LaserScan> ScanMaker::make(const lms200::ScanTelegram& telegram, lms200::MeasuringMode mode,
                                  RobotTime first_byte) {
  if (Status fits = check(telegram); !fits) {
    return tl::unexpected<Error>(fits.error());
  }
  LaserScan scan;
  scan.stamp = clock_.place(first_byte) - latency_;
  const double first = params_.sub_range ? params_.sub_range->first - 1.0 : 0.0;
  scan.angle_step_rad = params_.variant.angle_step_rad();
  scan.angle_min_rad = params_.variant.angle_min_rad() + first * scan.angle_step_rad;
  scan.range_min_m = params_.range_min_m;
  scan.range_max_m = lms200::range_limit_m(mode, telegram.unit);
  scan.base_T_laser = params_.base_T_laser;
  scan.ranges_m.resize(telegram.words.size());
  std::transform(telegram.words.begin(), telegram.words.end(), scan.ranges_m.begin(),
                 [&](std::uint16_t word) { return lms200::range_of(word, mode, telegram.unit); });
  return scan;
}

}  // namespace seeker::drivers
