// What is in the way between this machine and a robot that works, and what to do about it.

#include <chrono>
#include <iomanip>

#include <nlohmann/json.hpp>

#include "client/cli/tls_bundle.hpp"
#include "client/cli/verbs.hpp"
#include "client/doctor/judge.hpp"
#include "client/doctor/way.hpp"
#include "client/values/values_json.hpp"
#include "common/rpc/endpoint.hpp"

namespace seeker::cli {
namespace {

using api::Finding;
using api::Verdict;
using Findings = std::vector<Finding>;

constexpr int kPings = 10;
/// Wall time to find out whether something listens at a port, unless --timeout says otherwise.
constexpr Duration kPortTime = std::chrono::seconds(3);

void append(Findings& to, const Findings& from) { to.insert(to.end(), from.begin(), from.end()); }

void check_files(const Context& context, const rpc::Endpoint& robot, Findings& findings) {
  const Result<std::optional<pki::BundleFiles>> files = bundle_for(context.tls, robot.host);
  if (!files) {
    findings.push_back(api::failed_finding("tls-files", files.error()));
  } else if (!*files) {
    findings.push_back({"tls-files", Verdict::kOk, "plain TCP is spoken, without certificates", ""});
  } else {
    const pki::CalendarTime now = std::chrono::system_clock::now();
    append(findings, doctor::judge(doctor::look_at(**files, now), now));
  }
}

void check_name(const rpc::Endpoint& robot, Findings& findings) {
  const Result<std::vector<std::string>> addresses = doctor::addresses_of(robot.host);
  if (!addresses) {
    findings.push_back(api::failed_finding("name", addresses.error()));
    return;
  }
  std::string list;
  for (const std::string& address : *addresses) {
    list += (list.empty() ? "" : ", ") + address;
  }
  findings.push_back({"name", Verdict::kOk, "'" + robot.host + "' is " + list, ""});
}

/// Where no session came about: because nobody listens, or for another reason.
void check_port(const Context& context, const rpc::Endpoint& robot, const Error& why, Findings& findings) {
  if (const Status port = doctor::try_port(robot.host, robot.port, context.timeout.value_or(kPortTime)); !port) {
    findings.push_back(api::failed_finding(
        "port", port.error(),
        "start seekerd on the robot ('seekerd --config FILE --print-config' checks its file), let it listen on an "
        "address that this machine reaches (server.address), and look for a firewall"));
    return;
  }
  findings.push_back({"port", Verdict::kOk, "something listens at " + rpc::to_string(robot), ""});
  findings.push_back(api::failed_finding("session", why, "look at the log of seekerd on the robot"));
}

/// Compares the clocks some times; the best comparison counts. A link without comparisons is timed by other calls.
void check_clocks(const Context& context, const Connection& connection, Findings& findings) {
  std::vector<Duration> round_trips;
  std::optional<Result<rpc::TimeSync>> best;
  for (int ping = 0; ping < kPings; ++ping) {
    const auto asked = std::chrono::steady_clock::now();
    if (connection.sync_time) {
      best = ask<rpc::TimeSync>(context, [&](const auto& reply) { connection.sync_time(reply); });
    } else if (const auto info = ask<api::RobotInfo>(context, &api::RobotApi::get_info); !info) {
      best = tl::unexpected<Error>(info.error());
    }
    if (best && !*best) {
      findings.push_back(api::failed_finding("round-trip", best->error()));
      return;
    }
    round_trips.emplace_back(std::chrono::steady_clock::now() - asked);
  }
  findings.push_back(doctor::judge_round_trips(round_trips));
  const bool known = best && *best;
  findings.push_back(known ? doctor::judge_clocks((*best)->robot_wall_minus_local, (*best)->round_trip / 2)
                           : doctor::judge_clocks(std::nullopt, {}));
}

/// Adds what `judge` makes of the answer to a call, or why there was none.
template <class T, class Judge>
void check_call(const Context& context, const std::string& check, void (api::RobotApi::*method)(api::Reply<T>),
                Findings& findings, Judge judge) {
  if (const Result<T> answer = ask<T>(context, method)) {
    append(findings, judge(*answer));
  } else {
    findings.push_back(api::failed_finding(check, answer.error()));
  }
}

/// What the robot has found out about its machine. One that is older than the call is no failure.
void check_machine(const Context& context, Findings& findings) {
  const auto found = ask<Findings>(context, &api::RobotApi::get_diagnosis);
  if (found) {
    append(findings, *found);
    return;
  }
  Finding finding = api::failed_finding("robot", found.error());
  const bool too_old = found.error().code == Errc::kUnsupportedVersion || found.error().code == Errc::kNotReady;
  if (too_old) {
    finding.verdict = Verdict::kWarning;
    finding.found = "the robot does not check its machine: " + finding.found;
    finding.remedy = "update seekerd on the robot; until then look at its disk, clock and memory by hand";
  }
  findings.push_back(std::move(finding));
}

void check_robot(const Context& context, const Connection& connection, const std::string& own_version,
                 Findings& findings) {
  check_call<api::RobotInfo>(context, "versions", &api::RobotApi::get_info, findings, [&](const api::RobotInfo& info) {
    return Findings{doctor::judge_versions(own_version, info)};
  });
  check_clocks(context, connection, findings);
  check_call<api::RobotStatus>(context, "status", &api::RobotApi::get_status, findings,
                               [](const api::RobotStatus& status) { return doctor::judge(status); });
  check_call<std::vector<api::ComponentInfo>>(
      context, "device", &api::RobotApi::list_components, findings,
      [](const std::vector<api::ComponentInfo>& components) { return doctor::judge(components); });
  check_machine(context, findings);
}

/// Red and yellow where the terminal shows colours.
std::string coloured(const Context& context, Verdict verdict, const std::string& text) {
  if (!context.colour || verdict == Verdict::kOk) {
    return text;
  }
  return (verdict == Verdict::kFailed ? "\x1b[31m" : "\x1b[33m") + text + "\x1b[0m";
}

void print(const Context& context, const Findings& findings) {
  if (context.json) {
    *context.out << json_line({{"ok", !doctor::has_failed(findings)}, {"checks", findings}}) << '\n';
    return;
  }
  constexpr std::size_t kVerdictColumn = 9;
  constexpr int kCheckColumn = 19;
  for (const Finding& finding : findings) {
    const std::string verdict(api::to_string(finding.verdict));
    *context.out << coloured(context, finding.verdict, verdict) << std::string(kVerdictColumn - verdict.size(), ' ')
                 << std::left << std::setw(kCheckColumn) << finding.check << finding.found
                 << (finding.remedy.empty() ? "" : "; " + finding.remedy) << '\n';
  }
}

}  // namespace

VerbResult examine(const Context& context, const Patient& patient, const Dial& dial) {
  const Result<rpc::Endpoint> endpoint = rpc::parse_endpoint(patient.robot);
  if (!endpoint) {
    return fail_with_context("--robot", endpoint.error());
  }
  Findings findings;
  check_files(context, *endpoint, findings);
  check_name(*endpoint, findings);
  if (!doctor::has_failed(findings)) {
    const Result<Connection> connection = dial();
    if (connection) {
      findings.push_back({"session", Verdict::kOk,
                          "the robot at " + rpc::to_string(*endpoint) + " lets '" + connection->client_name +
                              "' in as " + std::string(api::to_string(connection->role)),
                          ""});
      Context connected = context;
      connected.robot = connection->robot;
      connected.link_error = connection->link_error;
      check_robot(connected, *connection, patient.own_version, findings);
    } else {
      check_port(context, *endpoint, connection.error(), findings);
    }
  }
  print(context, findings);
  return doctor::has_failed(findings) ? ExitCode::kFailed : ExitCode::kOk;
}

}  // namespace seeker::cli
