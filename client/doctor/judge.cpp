#include "client/doctor/judge.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <iterator>
#include <utility>

#include "common/core/assert.hpp"

namespace seeker::doctor {
namespace {

using api::failed_finding;
using api::Finding;
using api::Verdict;

std::string time_text(Duration time) {
  std::array<char, 32> text{};
  const bool long_one = time >= std::chrono::seconds(1);
  std::snprintf(text.data(), text.size(), long_one ? "%.1f s" : "%.1f ms", (long_one ? 1.0 : 1e3) * to_seconds(time));
  return text.data();
}

std::string protocol_text(std::uint32_t major, std::uint32_t minor) {
  return std::to_string(major) + "." + std::to_string(minor);
}

Finding judge_certificate(const OwnFiles& files, pki::CalendarTime now) {
  const std::string check = "tls-certificate";
  const std::string again = "have it issued again ('seeker pki issue --overwrite')";
  if (!files.believed) {
    return failed_finding(check, files.believed.error(), again);
  }
  const pki::CertificateFacts& facts = *files.certificate;
  const std::string role = facts.role ? std::string(pki::to_string(*facts.role)) : "no role";
  const std::string who = "the certificate is of '" + facts.name + "', " + role + ", ";
  if (pki::expires_soon(facts.not_after, now)) {
    return {check, Verdict::kWarning, who + "and expires on " + pki::date_text(facts.not_after), again};
  }
  return {check, Verdict::kOk, who + "valid until " + pki::date_text(facts.not_after), ""};
}

Finding judge_lease(const api::LeaseState& lease) {
  if (lease.owner.empty()) {
    return {"lease", Verdict::kOk, "nobody holds the lease", ""};
  }
  if (lease.stale) {
    return {"lease", Verdict::kWarning, "'" + lease.owner + "' holds the lease and is not heard",
            "acquire it ('seeker lease acquire'), or wait until its owner is back"};
  }
  return {"lease", Verdict::kOk,
          "'" + lease.owner + "' holds the lease" +
              (lease.requested_by.empty() ? "" : ", '" + lease.requested_by + "' asks for it"),
          ""};
}

Finding judge_estop(bool engaged) {
  return engaged ? Finding{"estop", Verdict::kWarning, "the emergency stop is latched, the robot does not move",
                           "when nobody is in danger: 'seeker estop --release'"}
                 : Finding{"estop", Verdict::kOk, "the emergency stop is released", ""};
}

Finding judge_loop(const std::optional<TickTiming>& timing) {
  if (!timing) {
    return {"loop", Verdict::kOk, "no wall clock paces the robot's loop, so that it cannot be late", ""};
  }
  const std::string found = std::to_string(timing->late) + " of " + std::to_string(timing->ticks) +
                            " ticks of the loop were late by more than " + time_text(TickTiming::kLate) +
                            ", the worst by " + time_text(timing->worst);
  if (static_cast<double>(timing->late) > kLateShare * static_cast<double>(timing->ticks)) {
    return {"loop", Verdict::kWarning, found,
            "end other programs on the robot, or give it less to do (fewer cameras, a simpler recogniser)"};
  }
  return {"loop", Verdict::kOk, found, ""};
}

Finding of_fault(const api::Fault& fault) {
  const Verdict verdict = fault.severity >= api::Severity::kError     ? Verdict::kFailed
                          : fault.severity == api::Severity::kWarning ? Verdict::kWarning
                                                                      : Verdict::kOk;
  return {"fault", verdict, fault.component + ": " + fault.message, fault.remedy};
}

}  // namespace

std::vector<Finding> judge(const OwnFiles& files, pki::CalendarTime now) {
  if (!files.usable) {
    return {failed_finding("tls-files", files.usable.error(), "have a bundle issued again ('seeker pki issue')")};
  }
  SEEKER_ASSERT(files.certificate);
  return {{"tls-files", Verdict::kOk, "certificate, key and CA can be read and belong together", ""},
          judge_certificate(files, now)};
}

Finding judge_versions(const std::string& own_version, const api::RobotInfo& robot) {
  const std::string found = "seeker " + own_version + " speaks protocol " +
                            protocol_text(api::kProtocolMajor, api::kProtocolMinor) + ", '" + robot.robot_id +
                            "' has seekerd " + robot.software_version + " with protocol " +
                            protocol_text(robot.protocol_major, robot.protocol_minor);
  if (robot.protocol_minor < api::kProtocolMinor) {
    return {"versions", Verdict::kWarning, found,
            "update seekerd on the robot: it refuses calls that are newer than it is"};
  }
  if (robot.protocol_minor > api::kProtocolMinor) {
    return {"versions", Verdict::kWarning, found, "update this program: the robot can do more than it asks for"};
  }
  return {"versions", Verdict::kOk, found, ""};
}

Finding judge_clocks(const std::optional<Duration>& robot_minus_own, Duration uncertainty) {
  if (!robot_minus_own) {
    return {"clocks", Verdict::kWarning, "the robot does not tell what its clock shows", "update seekerd on the robot"};
  }
  const Duration apart = std::max(*robot_minus_own, -*robot_minus_own);
  const std::string found = "the robot's clock is " + time_text(apart) +
                            (*robot_minus_own < Duration::zero() ? " behind" : " ahead of") +
                            " this machine's, known to " + time_text(uncertainty);
  // What is not known cannot be held against it.
  const Duration surely = apart - uncertainty;
  const Verdict verdict = surely > kClockFailure   ? Verdict::kFailed
                          : surely > kClockWarning ? Verdict::kWarning
                                                   : Verdict::kOk;
  return {"clocks", verdict, found,
          verdict == Verdict::kOk ? "" : "have a time server keep both clocks ('timedatectl set-ntp true')"};
}

Finding judge_round_trips(std::vector<Duration> round_trips) {
  SEEKER_ASSERT(!round_trips.empty());
  std::sort(round_trips.begin(), round_trips.end());
  const Duration median = round_trips[round_trips.size() / 2];
  const std::string found = "of " + std::to_string(round_trips.size()) + " calls half were answered within " +
                            time_text(median) + ", all within " + time_text(round_trips.back());
  if (round_trips.back() > kSlowAnswer) {
    return {"round-trip", Verdict::kWarning, found,
            "go nearer to the access point, or use a cable; driving by hand would be jerky"};
  }
  return {"round-trip", Verdict::kOk, found, ""};
}

std::vector<Finding> judge(const api::RobotStatus& status) {
  std::vector<Finding> findings{judge_lease(status.lease), judge_estop(status.estop), judge_loop(status.timing)};
  std::transform(status.faults.begin(), status.faults.end(), std::back_inserter(findings), of_fault);
  if (status.faults.empty()) {
    findings.push_back({"fault", Verdict::kOk, "the robot reports no fault", ""});
  }
  return findings;
}

std::vector<Finding> judge(const std::vector<api::ComponentInfo>& components) {
  std::vector<Finding> findings;
  for (const api::ComponentInfo& component : components) {
    const std::string who = "component '" + component.name + "' (" + component.type + ") ";
    if (component.state == api::ComponentState::kError) {
      findings.push_back({"device", Verdict::kFailed, who + "does not work: " + component.last_error,
                          "when the cause is gone: 'seeker components --restart " + component.name + "'"});
    } else if (component.state == api::ComponentState::kInactive) {
      findings.push_back({"device", Verdict::kWarning, who + "is switched off, which holds the robot still",
                          "'seeker components activate " + component.name + "' switches it on"});
    }
  }
  if (findings.empty()) {
    findings.push_back({"device", Verdict::kOk, "all " + std::to_string(components.size()) + " components work", ""});
  }
  return findings;
}

bool has_failed(const std::vector<Finding>& findings) {
  return std::any_of(findings.begin(), findings.end(),
                     [](const Finding& finding) { return finding.verdict == Verdict::kFailed; });
}

}  // namespace seeker::doctor
