#include "common/wire/convert.hpp"

namespace seeker::wire {

void write(const api::Finding& from, pb::Finding* to) {
  to->set_check(clean_text(from.check, kMaxNameBytes));
  to->set_verdict(static_cast<pb::Verdict>(wire_enum(from.verdict)));
  to->set_found(clean_text(from.found));
  to->set_remedy(clean_text(from.remedy));
}

void read(const pb::Finding& from, api::Finding& to, Check& check) {
  to.check = check.text("check", from.check(), kMaxNameBytes);
  check.enumerator("verdict", from.verdict(), api::Verdict::kFailed, to.verdict);
  to.found = check.text("found", from.found());
  to.remedy = check.text("remedy", from.remedy());
}

void set_outcome(api::AuditRecord& record, const Status& outcome) {
  record.outcome = outcome ? "ok" : std::string(to_string(outcome.error().code));
  record.message = outcome ? "" : one_line(outcome.error().message, api::kMaxAuditMessage_bytes);
}

void write(const api::AuditRecord& from, pb::AuditRecord* to) {
  to->set_number(from.number);
  to->set_unix_ns(from.unix_ns);
  to->set_robot_time_ns(from.stamp.time_since_epoch().count());
  to->set_client(clean_text(from.client, kMaxNameBytes));
  to->set_role(clean_text(from.role, kMaxNameBytes));
  to->set_certificate(clean_text(from.certificate, kMaxNameBytes));
  to->set_serial(clean_text(from.serial, kMaxNameBytes));
  to->set_address(clean_text(from.address, kMaxAddressBytes));
  to->set_call(clean_text(from.call, kMaxNameBytes));
  to->set_essentials(clean_text(from.essentials, api::kMaxAuditEssentials_bytes));
  to->set_outcome(clean_text(from.outcome, kMaxNameBytes));
  to->set_message(clean_text(from.message, api::kMaxAuditMessage_bytes));
}

void read(const pb::AuditRecord& from, api::AuditRecord& to, Check& check) {
  to.number = from.number();
  to.unix_ns = from.unix_ns();
  to.stamp = RobotTime(Duration(from.robot_time_ns()));
  to.client = check.text("client", from.client(), kMaxNameBytes);
  to.role = check.text("role", from.role(), kMaxNameBytes);
  to.certificate = check.text("certificate", from.certificate(), kMaxNameBytes);
  to.serial = check.text("serial", from.serial(), kMaxNameBytes);
  to.address = check.text("address", from.address(), kMaxAddressBytes);
  to.call = check.text("call", from.call(), kMaxNameBytes);
  to.essentials = check.text("essentials", from.essentials(), api::kMaxAuditEssentials_bytes);
  to.outcome = check.text("outcome", from.outcome(), kMaxNameBytes);
  to.message = check.text("message", from.message(), api::kMaxAuditMessage_bytes);
}

}  // namespace seeker::wire
