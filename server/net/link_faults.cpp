#include "server/net/link_faults.hpp"

namespace seeker::server_net {
namespace {

constexpr const char* kComponent = "link";

api::Fault expiry_fault(const net::LinkHealth& health, pki::CalendarTime now) {
  const bool over = health.expires <= now;
  return {.id = "certificate-expiry",
          .component = kComponent,
          .severity = over ? api::Severity::kError : api::Severity::kWarning,
          .onset = {},
          .message = "the robot's certificate '" + health.name + (over ? "' has expired on " : "' expires on ") +
                     pki::date_text(health.expires),
          .remedy = "issue it again ('seeker pki issue --overwrite') and copy it to the robot; no restart is needed"};
}

}  // namespace

std::vector<api::Fault> link_faults(const net::LinkHealth& health, pki::CalendarTime now) {
  std::vector<api::Fault> faults;
  if (health.insecure) {
    faults.push_back({.id = "link-insecure",
                      .component = kComponent,
                      .severity = api::Severity::kWarning,
                      .onset = {},
                      .message = "everybody who reaches " + health.address + " may command the robot",
                      .remedy = "set server.tls with certificates of 'seeker pki', or listen on 127.0.0.1"});
  }
  if (health.problem) {
    faults.push_back({.id = "certificate-files",
                      .component = kComponent,
                      .severity = api::Severity::kWarning,
                      .onset = {},
                      .message = "the former certificates stay in use: " + health.problem->message,
                      .remedy = "copy the files of one bundle again"});
  }
  if (health.tls && pki::expires_soon(health.expires, now)) {
    faults.push_back(expiry_fault(health, now));
  }
  return faults;
}

}  // namespace seeker::server_net
