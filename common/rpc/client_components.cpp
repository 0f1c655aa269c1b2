// The calls about components.

#include <utility>

#include "common/rpc/answers.hpp"
#include "common/rpc/client_impl.hpp"
#include "common/rpc/robot_client.hpp"

namespace seeker::rpc {

void RobotClient::list_components(api::Reply<std::vector<api::ComponentInfo>> reply) {
  pb::Request request;
  request.mutable_list_components();
  impl_->call(std::move(request),
              value_answer<std::vector<api::ComponentInfo>>(std::move(reply), [](const Responses& r) {
                return read_list<api::ComponentInfo>(r.front().list_components().components(), wire::kMaxComponents);
              }));
}

void RobotClient::restart_component(const std::string& name, api::Reply<void> reply) {
  pb::Request request;
  request.mutable_restart_component()->set_name(wire::clean_text(name));
  impl_->call(std::move(request), empty_answer(std::move(reply)));
}

void RobotClient::switch_component(const std::string& name, bool active, api::Reply<void> reply) {
  pb::Request request;
  pb::SwitchComponentRequest* call = request.mutable_switch_component();
  call->set_name(wire::clean_text(name));
  call->set_active(active);
  impl_->call(std::move(request), empty_answer(std::move(reply)));
}

void RobotClient::exchange_component(const std::string& name, const std::string& type, api::Reply<void> reply) {
  pb::Request request;
  pb::ExchangeComponentRequest* call = request.mutable_exchange_component();
  call->set_name(wire::clean_text(name));
  call->set_type(wire::clean_text(type));
  impl_->call(std::move(request), empty_answer(std::move(reply)));
}

void RobotClient::get_settings(const std::string& component, api::Reply<std::vector<api::ComponentSetting>> reply) {
  pb::Request request;
  request.mutable_get_settings()->set_component(wire::clean_text(component));
  impl_->call(std::move(request),
              value_answer<std::vector<api::ComponentSetting>>(std::move(reply), [](const Responses& r) {
                return read_list<api::ComponentSetting>(r.front().get_settings().settings(), wire::kMaxSettings);
              }));
}

void RobotClient::set_settings(const std::string& component, const std::vector<std::string>& assignments,
                               api::Reply<std::vector<api::ComponentSetting>> reply) {
  pb::Request request;
  pb::SetSettingsRequest* call = request.mutable_set_settings();
  call->set_component(wire::clean_text(component));
  for (const std::string& assignment : assignments) {
    call->add_assignments(wire::clean_text(assignment));
  }
  impl_->call(std::move(request),
              value_answer<std::vector<api::ComponentSetting>>(std::move(reply), [](const Responses& r) {
                return read_list<api::ComponentSetting>(r.front().set_settings().settings(), wire::kMaxSettings);
              }));
}

}  // namespace seeker::rpc
