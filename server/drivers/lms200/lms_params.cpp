#include "server/drivers/lms200/lms_params.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "server/protocols/lms200/baud_rate.hpp"
#include "server/protocols/lms200/telegram.hpp"

namespace seeker::drivers {
namespace {

tl::unexpected<Error> wrong(const std::string& sentence) { return fail(Errc::kInvalidArgument, sentence); }

Status check_rates(const LmsParams& params) {
  std::vector<std::uint32_t> rates = params.search_bauds;
  rates.push_back(params.baud);
  const auto unknown =
      std::find_if(rates.begin(), rates.end(), [](std::uint32_t baud) { return !lms200::baud_mode(baud); });
  return unknown == rates.end() ? Status()
                                : wrong("the LMS200 has no rate of " + std::to_string(*unknown) +
                                        " baud; choose 9600, 19200, 38400 or, on RS-422, 500000");
}

Status check_times(const LmsParams& params) {
  for (const double time_s : {params.scan_timeout_s, params.reply_timeout_s, params.mode_timeout_s,
                              params.flash_timeout_s, params.partial_timeout_s}) {
    if (!std::isfinite(time_s) || time_s <= 0.0) {
      return wrong("each timeout of the LMS200 must be above 0 s");
    }
  }
  for (const double time_s : {params.baud_settle_s, params.retry_pause_s, params.device_latency_s}) {
    if (!std::isfinite(time_s) || time_s < 0.0) {
      return wrong("pauses and latency of the LMS200 must be at least 0 s");
    }
  }
  const double longest_s = to_seconds(lms200::transfer_time(lms200::kMaxTelegramBytes, params.baud));
  if (params.scan_timeout_s < 2.0 * longest_s) {
    return wrong("scan_timeout_s is too short for two scans at " + std::to_string(params.baud) +
                 " baud; choose at least " + std::to_string(2.0 * longest_s) + " s");
  }
  return {};
}

}  // namespace

std::size_t beams_of(const LmsParams& params) {
  return params.sub_range ? std::size_t{params.sub_range->last} + 1 - params.sub_range->first : params.variant.beams();
}

Status validate(const LmsParams& params) {
  if (Status rates = check_rates(params); !rates) {
    return rates;
  }
  if (!lms200::is_variant(params.variant)) {
    return wrong("the LMS200 has no variant " + to_string(params.variant) +
                 "; choose 180/1, 180/0.5, 100/1, 100/0.5 or 100/0.25 deg");
  }
  if (params.measuring_mode == lms200::MeasuringMode::kReflectivity) {
    return wrong("the measuring mode 'reflectivity' gives no ranges; choose another one");
  }
  if (params.sub_range && (params.sub_range->first < 1 || params.sub_range->last < params.sub_range->first ||
                           params.sub_range->last > params.variant.beams())) {
    return wrong("the sub-range must lie within 1 and " + std::to_string(params.variant.beams()) +
                 ", the values of the variant " + to_string(params.variant));
  }
  if (params.tries < 1 || params.search_tries < 1 || params.rounds < 1) {
    return wrong("each number of tries of the LMS200 must be at least 1");
  }
  if (!is_finite(params.base_T_laser) || !std::isfinite(params.range_min_m) || params.range_min_m < 0.0) {
    return wrong("base_T_laser must be finite and range_min_m at least 0 m");
  }
  return check_times(params);
}

}  // namespace seeker::drivers
