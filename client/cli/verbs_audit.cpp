// Who commanded what.

#include <nlohmann/json.hpp>

#include "client/cli/verbs.hpp"
#include "client/values/values_json.hpp"
#include "common/pki/certificate.hpp"

namespace seeker::cli {
namespace {

std::string audit_line(const api::AuditRecord& record) {
  std::string who = record.client.empty() ? "somebody" : record.client;
  if (!record.role.empty()) {
    who += " (" + record.role + (record.serial.empty() ? "" : ", certificate " + record.serial) + ")";
  }
  return wall_time_text(record.unix_ns) + "  " + who + (record.address.empty() ? "" : " at " + record.address) + ": " +
         record.call + (record.essentials.empty() ? "" : " ") + record.essentials + ": " + record.outcome +
         (record.message.empty() ? "" : ", " + record.message);
}

}  // namespace

VerbResult show_audit(const Context& context, const AuditVerb& verb) {
  const auto records = ask<std::vector<api::AuditRecord>>(context, [&](const auto& reply) {
    context.robot->get_audit({verb.last, verb.client}, reply);
  });
  if (!records) {
    return tl::unexpected<Error>(records.error());
  }
  if (context.json) {
    *context.out << json_line(Json{{"records", *records}}) << '\n';
    return ExitCode::kOk;
  }
  for (const api::AuditRecord& record : *records) {
    *context.out << audit_line(record) << '\n';
  }
  if (records->empty()) {
    say(context, "nobody has commanded anything yet");
  }
  return ExitCode::kOk;
}

}  // namespace seeker::cli
