// The calls about what the robot has checked, and about who commanded it.

#include <algorithm>
#include <string>
#include <vector>

#include "server/net/responder.hpp"

namespace seeker::server_net {
namespace {

void get_diagnosis(const Responder& responder, api::RobotApi& robot) {
  robot.get_diagnosis(
      reply_with<std::vector<api::Finding>>(responder, [](const std::vector<api::Finding>& findings, pb::Response& to) {
        const std::size_t count = std::min(findings.size(), wire::kMaxFindings);
        for (std::size_t k = 0; k < count; ++k) {
          wire::write(findings[k], to.mutable_get_diagnosis()->add_findings());
        }
      }));
}

void get_audit(const Responder& responder, api::RobotApi& robot, const pb::GetAuditRequest& request) {
  if (request.last() == 0 || request.last() > api::kMaxAuditRecords) {
    responder.answer_now(
        fail(Errc::kInvalidArgument, "field 'last' must be 1 to " + std::to_string(api::kMaxAuditRecords)));
    return;
  }
  if (request.client().size() > wire::kMaxNameBytes) {
    responder.answer_now(fail(Errc::kInvalidArgument, "field 'client' is longer than 64 bytes"));
    return;
  }
  robot.get_audit({request.last(), request.client()},
                  reply_with<std::vector<api::AuditRecord>>(
                      responder, [](const std::vector<api::AuditRecord>& records, pb::Response& to) {
                        for (const api::AuditRecord& record : records) {
                          wire::write(record, to.mutable_get_audit()->add_records());
                        }
                      }));
}

}  // namespace

bool handle_diagnosis_call(const Responder& responder, Session& session, const pb::Request& request) {
  switch (request.call_case()) {
    case pb::Request::kGetDiagnosis: get_diagnosis(responder, session.robot()); return true;
    case pb::Request::kGetAudit: get_audit(responder, session.robot(), request.get_audit()); return true;
    default: return false;
  }
}

}  // namespace seeker::server_net
