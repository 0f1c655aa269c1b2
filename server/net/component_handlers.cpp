// The calls about components: their list, lifecycle, type and settings.

#include <algorithm>
#include <string>
#include <vector>

#include "server/net/responder.hpp"

namespace seeker::server_net {
namespace {

/// Calls `go` when the texts are names of 1 to 64 bytes; else responds with the error.
template <class Go>
void with_names(const Responder& responder, std::initializer_list<std::pair<const char*, const std::string*>> names,
                Go go) {
  for (const auto& [field, name] : names) {
    if (name->empty() || name->size() > wire::kMaxNameBytes) {
      responder.answer_now(fail(Errc::kInvalidArgument, "field '" + std::string(field) + "' must have 1 to 64 bytes"));
      return;
    }
  }
  go();
}

void list_components(const Responder& responder, api::RobotApi& robot) {
  robot.list_components(reply_with<std::vector<api::ComponentInfo>>(
      responder, [](const std::vector<api::ComponentInfo>& components, pb::Response& to) {
        for (const api::ComponentInfo& component : components) {
          wire::write(component, to.mutable_list_components()->add_components());
        }
      }));
}

void get_settings(const Responder& responder, api::RobotApi& robot, const pb::GetSettingsRequest& request) {
  with_names(responder, {{"component", &request.component()}}, [&] {
    robot.get_settings(request.component(),
                       reply_with<std::vector<api::ComponentSetting>>(
                           responder, [](const std::vector<api::ComponentSetting>& settings, pb::Response& to) {
                             for (const api::ComponentSetting& setting : settings) {
                               wire::write(setting, to.mutable_get_settings()->add_settings());
                             }
                           }));
  });
}

void set_settings(const Responder& responder, api::RobotApi& robot, const pb::SetSettingsRequest& request) {
  const auto count = static_cast<std::size_t>(request.assignments_size());
  if (count == 0 || count > wire::kMaxAssignments) {
    responder.answer_now(fail(Errc::kInvalidArgument, "field 'assignments' must have 1 to 64 entries"));
    return;
  }
  const auto& assignments = request.assignments();
  if (std::any_of(assignments.begin(), assignments.end(),
                  [](const std::string& text) { return text.size() > wire::kMaxTextBytes; })) {
    responder.answer_now(fail(Errc::kTooLarge, "field 'assignments' has an entry of more than 4096 bytes"));
    return;
  }
  with_names(responder, {{"component", &request.component()}}, [&] {
    robot.set_settings(request.component(), {assignments.begin(), assignments.end()},
                       reply_with<std::vector<api::ComponentSetting>>(
                           responder, [](const std::vector<api::ComponentSetting>& settings, pb::Response& to) {
                             for (const api::ComponentSetting& setting : settings) {
                               wire::write(setting, to.mutable_set_settings()->add_settings());
                             }
                           }));
  });
}

}  // namespace

bool handle_component_call(const Responder& responder, Session& session, const pb::Request& request) {
  using R = pb::Request;
  api::RobotApi& robot = session.robot();
  switch (request.call_case()) {
    case R::kListComponents: list_components(responder, robot); return true;
    case R::kRestartComponent:
      with_names(responder, {{"name", &request.restart_component().name()}},
                 [&] { robot.restart_component(request.restart_component().name(), reply_empty(responder)); });
      return true;
    case R::kSwitchComponent:
      with_names(responder, {{"name", &request.switch_component().name()}}, [&] {
        robot.switch_component(request.switch_component().name(), request.switch_component().active(),
                               reply_empty(responder));
      });
      return true;
    case R::kExchangeComponent:
      with_names(responder,
                 {{"name", &request.exchange_component().name()}, {"type", &request.exchange_component().type()}}, [&] {
                   robot.exchange_component(request.exchange_component().name(), request.exchange_component().type(),
                                            reply_empty(responder));
                 });
      return true;
    case R::kGetSettings: get_settings(responder, robot, request.get_settings()); return true;
    case R::kSetSettings: set_settings(responder, robot, request.set_settings()); return true;
    default: return false;
  }
}

}  // namespace seeker::server_net
