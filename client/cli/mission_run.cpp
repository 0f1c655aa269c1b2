#include "client/cli/mission_run.hpp"

#include <algorithm>
#include <array>
#include <ctime>
#include <random>

#include <nlohmann/json.hpp>

#include "client/cli/transfer.hpp"
#include "client/values/values.hpp"
#include "client/values/values_json.hpp"

namespace seeker::cli {
namespace {

using SteadyClock = std::chrono::steady_clock;

/// Without news for this long the robot is asked: an update may have been missed over a restart of the robot.
constexpr Duration kAskAfter = std::chrono::seconds(2);
constexpr Duration kStopAnswerTime = std::chrono::seconds(3);
/// The end comes soon after a stop, as the robot only brakes.
constexpr Duration kEndAfterStop = std::chrono::seconds(10);

/// The same context for clean-up: Ctrl-C does not cut it short.
Context for_clean_up(const Context& context) {
  Context calm = context;
  calm.interrupted = [] { return false; };
  calm.timeout = kStopAnswerTime;
  return calm;
}

Status stop_mission(const Context& context) {
  return ask<void>(for_clean_up(context), [&](api::Reply<void> reply) { context.robot->stop(std::move(reply)); });
}

}  // namespace

api::MissionId make_mission_id(const std::string& kind) {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  std::array<char, 32> stamp{};
  (void)std::strftime(stamp.data(), stamp.size(), "-%Y%m%d-%H%M%S-", &local);
  std::random_device random;
  constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz0123456789";
  std::string id = kind + stamp.data();
  for (int i = 0; i < 4; ++i) {
    id += kLetters[random() % kLetters.size()];
  }
  return id;
}

Result<MissionRun> MissionRun::start(const Context& context, const api::MissionRequest& request) {
  MissionRun run;
  run.request_ = request;
  Result<Stream> stream = open_stream(
      *context.robot, {{api::Topic::kMission, 0.0, 0}, {api::Topic::kEvent, 0.0, 0}, {api::Topic::kDetection, 0.0, 0}});
  if (!stream) {
    return tl::unexpected<Error>(stream.error());
  }
  run.stream_ = std::move(*stream);
  run.started_ = SteadyClock::now();
  const Result<api::MissionRequest> sent = send_pictures(context, request);
  if (!sent) {
    return tl::unexpected<Error>(sent.error());
  }
  Result<api::MissionAccepted> accepted = ask<api::MissionAccepted>(
      context, [&](api::Reply<api::MissionAccepted> reply) { context.robot->start_mission(*sent, std::move(reply)); });
  if (!accepted) {
    return tl::unexpected<Error>(accepted.error());
  }
  run.report_.status.id = accepted->id;
  run.link_steps_ = std::move(accepted->link_steps);
  return run;
}

void MissionRun::take(const Context& context, const api::Update& update) {
  if (const auto* mission = std::get_if<api::MissionStatus>(&update.payload)) {
    if (mission->id == report_.status.id) {
      report_.status = *mission;
      show_decision(context);
      show_progress(context);
      if (!context.err_is_tty && mission->phase != phase_shown_ && !mission->end) {
        phase_shown_ = mission->phase;
        say(context, text_of(update));
      }
    }
  } else if (const auto* detection = std::get_if<api::Detection>(&update.payload)) {
    if (take(*detection)) {
      say(context, text_of(update));
    }
  } else if (const auto* event = std::get_if<api::Event>(&update.payload)) {
    if (context.verbose || event->severity >= api::Severity::kWarning) {
      say(context, text_of(update));
    }
  }
}

bool MissionRun::take(const api::Detection& detection) {
  // Robots of older versions do not say which mission has found it.
  if (!detection.mission.empty() && detection.mission != report_.status.id) {
    return false;
  }
  const auto known = std::find_if(report_.detections.begin(), report_.detections.end(),
                                  [&](const api::Detection& d) { return d.id == detection.id; });
  const bool is_known = known != report_.detections.end();
  if (detection.withdrawn && is_known) {
    report_.detections.erase(known);
  } else if (is_known) {
    *known = detection;
  } else if (!detection.withdrawn) {
    report_.detections.push_back(detection);
  }
  return detection.withdrawn == is_known;
}

/// The robot's own list is the newest. It lacks what was found before the robot was restarted, which only the stream
/// has reported.
void MissionRun::take_list(const Context& context) {
  const auto list = ask<std::vector<api::Detection>>(context, &api::RobotApi::get_detections);
  for (const api::Detection& detection : list ? *list : std::vector<api::Detection>()) {
    take(detection);
  }
}

void MissionRun::show_progress(const Context& context) const {
  if (!context.err_is_tty || context.quiet) {
    return;
  }
  const api::MissionStatus& m = report_.status;
  std::string line = fixed("%3.0f %%  ", 100.0 * m.progress) + m.phase + (m.activity.empty() ? "" : ": " + m.activity) +
                     fixed("  | %.0f s", to_seconds(m.updated - m.started)) + fixed(", %.1f m", m.path_length_m);
  if (m.coverage) {
    line += fixed(", %.0f of ", m.coverage->covered_area_m2) + fixed("%.0f m\xC2\xB2", m.coverage->reachable_area_m2);
  }
  constexpr std::size_t kColumns = 110;
  line.resize(std::min(line.size(), kColumns));
  *context.err << "\r\x1b[K" << (m.end ? "" : line) << std::flush;
}

void MissionRun::show_decision(const Context& context) {
  const std::optional<ExploreDecision>& decision = report_.status.decision;
  if (!decision || decision->number <= decision_shown_) {
    return;
  }
  decision_shown_ = decision->number;
  if (!context.json) {
    say(context, text_of(*decision));
  } else if (decision_lines_) {
    *context.out << json_line({{"mission", report_.status.id}, {"decision", *decision}}) << '\n' << std::flush;
  }
}

Status MissionRun::poll(const Context& context) {
  const Result<api::MissionStatus> status = ask<api::MissionStatus>(context, &api::RobotApi::get_mission);
  if (status && status->id == report_.status.id) {
    report_.status = *status;
    show_decision(context);
    return {};
  }
  if (status || status.error().code == Errc::kNotFound) {
    return fail(Errc::kNotReady, "the robot no longer knows mission '" + report_.status.id +
                                     "': it was restarted, or another mission took its place; see seeker status");
  }
  // No answer: the link is made again, or link_error() ends the wait.
  return {};
}

Error MissionRun::stop_because(const Context& context, Error why) const {
  if (why.code == Errc::kLinkLost) {
    why.message += "; the robot follows the mission's link policy: " + text_of(link_steps_, request_.link_policy);
    return why;
  }
  say(context, "asking the robot to stop mission '" + report_.status.id + "'");
  const Status stopped = stop_mission(context);
  why.message += stopped ? "; the robot stopped the mission"
                         : "; the robot was asked to stop the mission but: " + stopped.error().message;
  return why;
}

Result<MissionReport> MissionRun::follow(const Context& context, const FollowOptions& options) {
  decision_lines_ = options.decisions;
  auto last_news = SteadyClock::now();
  auto deadline = options.wall ? started_ + *options.wall : SteadyClock::time_point::max();
  while (!report_.status.end) {
    if (const auto update = stream_.queue->pop(kPollPeriod)) {
      take(context, **update);
      last_news = SteadyClock::now();
    }
    if (report_.status.end) {
      break;
    }
    if (const std::optional<Error> error = broken(context)) {
      return tl::unexpected<Error>(stop_because(context, *error));
    }
    const auto now = SteadyClock::now();
    if (now >= deadline) {
      return tl::unexpected<Error>(stop_because(
          context, Error{Errc::kTimeout, report_.overran ? "the mission did not end after it was stopped"
                                                         : "the mission did not end in the time of --timeout"}));
    }
    if (options.robot && !report_.overran && report_.status.updated - report_.status.started > *options.robot) {
      report_.overran = true;
      say(context, "the mission is over its time; stopping it");
      if (const Status stopped = stop_mission(context); !stopped && stopped.error().code != Errc::kNotFound) {
        return tl::unexpected<Error>(stopped.error());
      }
      deadline = std::min(deadline, now + kEndAfterStop);
    }
    if (now - last_news >= kAskAfter) {
      last_news = now;
      if (const Status ok = poll(context); !ok) {
        return tl::unexpected<Error>(ok.error());
      }
    }
  }
  take_list(for_clean_up(context));
  while (const auto update = stream_.queue->pop(Duration::zero())) {
    take(context, **update);
  }
  show_progress(context);
  report_.wall = SteadyClock::now() - started_;
  return report_;
}

}  // namespace seeker::cli
