// The calls of the remote client about databases of landmarks.

#include <utility>

#include "common/rpc/answers.hpp"
#include "common/rpc/client_impl.hpp"

namespace seeker::rpc {

void RobotClient::list_landmarks(api::Reply<std::vector<api::LandmarkSummary>> reply) {
  pb::Request request;
  request.mutable_list_landmarks();
  impl_->call(
      std::move(request), value_answer<std::vector<api::LandmarkSummary>>(std::move(reply), [](const Responses& r) {
        return read_list<api::LandmarkSummary>(r.front().list_landmarks().databases(), api::kMaxLandmarkDatabases);
      }));
}

void RobotClient::inspect_landmarks(const std::string& name, bool verify, api::Reply<api::LandmarkSummary> reply) {
  pb::Request request;
  request.mutable_inspect_landmarks()->set_name(wire::clean_text(name));
  request.mutable_inspect_landmarks()->set_verify(verify);
  impl_->call(std::move(request), value_answer<api::LandmarkSummary>(std::move(reply), [](const Responses& r) {
                return wire::from_message<api::LandmarkSummary>(r.front().inspect_landmarks().database());
              }));
}

void RobotClient::get_landmarks(const std::string& name, api::Reply<std::vector<api::LandmarkPoint>> reply) {
  pb::Request request;
  request.mutable_get_landmarks()->set_name(wire::clean_text(name));
  impl_->call(std::move(request),
              value_answer<std::vector<api::LandmarkPoint>>(std::move(reply), [](const Responses& r) {
                return read_list<api::LandmarkPoint>(r.front().get_landmarks().landmarks(), api::kMaxLandmarks);
              }));
}

void RobotClient::prune_landmarks(const std::string& name, int min_views, api::Reply<api::LandmarkSummary> reply) {
  pb::Request request;
  request.mutable_prune_landmarks()->set_name(wire::clean_text(name));
  request.mutable_prune_landmarks()->set_min_views(static_cast<std::uint32_t>(min_views));
  impl_->call(std::move(request), value_answer<api::LandmarkSummary>(std::move(reply), [](const Responses& r) {
                return wire::from_message<api::LandmarkSummary>(r.front().prune_landmarks().database());
              }));
}

void RobotClient::revert_landmarks(const std::string& name, api::Reply<api::LandmarkSummary> reply) {
  pb::Request request;
  request.mutable_revert_landmarks()->set_name(wire::clean_text(name));
  impl_->call(std::move(request), value_answer<api::LandmarkSummary>(std::move(reply), [](const Responses& r) {
                return wire::from_message<api::LandmarkSummary>(r.front().revert_landmarks().database());
              }));
}

void RobotClient::delete_landmarks(const std::string& name, api::Reply<void> reply) {
  pb::Request request;
  request.mutable_delete_landmarks()->set_name(wire::clean_text(name));
  impl_->call(std::move(request), empty_answer(std::move(reply)));
}

}  // namespace seeker::rpc
