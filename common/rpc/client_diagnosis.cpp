// The calls about what the robot has checked and recorded.

#include <utility>

#include "common/rpc/answers.hpp"
#include "common/rpc/client_impl.hpp"
#include "common/rpc/robot_client.hpp"

namespace seeker::rpc {

void RobotClient::get_diagnosis(api::Reply<std::vector<api::Finding>> reply) {
  pb::Request request;
  request.mutable_get_diagnosis();
  impl_->call(std::move(request), value_answer<std::vector<api::Finding>>(std::move(reply), [](const Responses& r) {
                return read_list<api::Finding>(r.front().get_diagnosis().findings(), wire::kMaxFindings);
              }));
}

void RobotClient::get_audit(const api::AuditQuery& query, api::Reply<std::vector<api::AuditRecord>> reply) {
  pb::Request request;
  request.mutable_get_audit()->set_last(query.last);
  request.mutable_get_audit()->set_client(wire::clean_text(query.client, wire::kMaxNameBytes));
  impl_->call(std::move(request), value_answer<std::vector<api::AuditRecord>>(std::move(reply), [](const Responses& r) {
                return read_list<api::AuditRecord>(r.front().get_audit().records(), api::kMaxAuditRecords);
              }));
}

}  // namespace seeker::rpc
