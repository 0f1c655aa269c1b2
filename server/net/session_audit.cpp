#include "server/net/session_audit.hpp"

#include <utility>

#include "common/wire/convert.hpp"
#include "common/wire/outcome.hpp"
#include "server/net/audit_text.hpp"

namespace seeker::server_net {
namespace {

namespace pb = ::seeker::v1;

std::string call_of(const pb::Request& request) {
  return wire::call_name(static_cast<wire::CallNumber>(request.call_case()));
}

/// Commands that follow each other in a row although they ask for different things.
std::string kind_of(const api::AuditRecord& record) {
  static const std::string kDrive = wire::call_name(pb::Request::kDrive);
  return record.call == kDrive ? record.call : record.call + " " + record.essentials;
}

}  // namespace

SessionAudit::SessionAudit(Sink sink, std::string address, const pki::CertificateFacts* certificate)
    : rows_(std::move(sink)) {
  base_.address = std::move(address);
  if (certificate != nullptr) {
    base_.certificate = certificate->name;
    base_.serial = certificate->serial;
  }
}

api::AuditRecord SessionAudit::record_of(const pb::Request& request, std::string essentials, const api::Caller& caller,
                                         const AuditClocks& now) const {
  api::AuditRecord record = base_;
  record.unix_ns = now.unix_ns;
  record.stamp = now.robot;
  record.client = caller.client_name;
  record.role = api::to_string(caller.role);
  record.call = call_of(request);
  record.essentials = std::move(essentials);
  return record;
}

void SessionAudit::asked(const pb::Request& request, const api::Caller& caller, const AuditClocks& now) {
  if (std::optional<std::string> essentials = audit_essentials(request)) {
    waiting_.emplace(request.header().request_id(), record_of(request, std::move(*essentials), caller, now));
  }
}

void SessionAudit::answered(const pb::Response& response, const AuditClocks& now) {
  const auto [first, last] = waiting_.equal_range(response.header().request_id());
  if (first == last) {
    return;  // most answers are to questions
  }
  const std::string call = wire::call_name(static_cast<wire::CallNumber>(response.result_case()));
  const bool named = response.result_case() != pb::Response::RESULT_NOT_SET;
  for (auto it = first; it != last; ++it) {
    if (!named || it->second.call == call) {
      api::AuditRecord record = std::move(it->second);
      waiting_.erase(it);
      wire::set_outcome(record, wire::outcome(response));
      const std::string kind = kind_of(record);
      rows_.add(std::move(record), kind, now.wall);
      return;
    }
  }
}

void SessionAudit::refused(const pb::Request& request, const pb::Response& response, const api::Caller& caller,
                           const AuditClocks& now) {
  if (std::optional<std::string> essentials = audit_essentials(request)) {
    api::AuditRecord record = record_of(request, std::move(*essentials), caller, now);
    wire::set_outcome(record, wire::outcome(response));
    rows_.add(std::move(record), call_of(request), now.wall);
  }
}

void SessionAudit::end(const AuditClocks& now) {
  for (auto& [id, record] : std::exchange(waiting_, {})) {
    record.outcome = "unknown";
    record.message = "the session ended before the answer";
    const std::string kind = kind_of(record);
    rows_.add(std::move(record), kind, now.wall);
  }
  rows_.end();
}

}  // namespace seeker::server_net
