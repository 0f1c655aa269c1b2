// Who may command the robot and who did, what it does without a client, and what was checked, as JSON.

#include <array>
#include <chrono>
#include <cstdio>

#include <nlohmann/json.hpp>

#include "client/values/values_json.hpp"

namespace seeker::api {

using cli::Json;

void to_json(Json& json, const LinkStep& step) {
  json = {{"after_s", to_seconds(step.after)}, {"action", to_string(step.action)}};
}

void to_json(Json& json, const LinkCountdown& countdown) {
  json = {{"silent_s", to_seconds(countdown.silent)},
          {"next", countdown.next ? Json(to_string(countdown.next->action)) : Json()},
          {"left_s", countdown.next ? Json(to_seconds(countdown.left)) : Json()}};
}

void to_json(Json& json, const LeaseState& lease) {
  json = {{"owner", lease.owner},
          {"epoch", lease.epoch},
          {"sequence", lease.sequence},
          {"stale", lease.stale},
          {"requested_by", lease.requested_by},
          {"request_left_s", to_seconds(lease.request_left)}};
}

void to_json(Json& json, const Finding& finding) {
  json = {{"name", finding.check},
          {"verdict", to_string(finding.verdict)},
          {"found", finding.found},
          {"remedy", finding.remedy}};
}

void to_json(Json& json, const AuditRecord& record) {
  json = {{"number", record.number},
          {"time", cli::wall_time_text(record.unix_ns)},
          {"stamp_s", to_seconds(record.stamp)},
          {"client", record.client},
          {"role", record.role},
          {"certificate", record.certificate},
          {"serial", record.serial},
          {"address", record.address},
          {"call", record.call},
          {"essentials", record.essentials},
          {"outcome", record.outcome},
          {"message", record.message}};
}

}  // namespace seeker::api

namespace seeker::cli {

std::string wall_time_text(std::int64_t unix_ns) {
  using namespace std::chrono;
  const sys_time<milliseconds> time(floor<milliseconds>(nanoseconds(unix_ns)));
  const sys_days day = floor<days>(time);
  const year_month_day date(day);
  const hh_mm_ss<milliseconds> of_day(time - day);
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%04d-%02u-%02uT%02d:%02d:%02d.%03dZ", static_cast<int>(date.year()),
                static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                static_cast<int>(of_day.hours().count()), static_cast<int>(of_day.minutes().count()),
                static_cast<int>(of_day.seconds().count()), static_cast<int>(of_day.subseconds().count()));
  return text.data();
}

}  // namespace seeker::cli
