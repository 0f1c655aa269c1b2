// Who may command the robot, and what it does without a client, as JSON.

#include <nlohmann/json.hpp>

#include "client/cli/values_json.hpp"

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

}  // namespace seeker::api
