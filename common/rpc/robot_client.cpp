#include "common/rpc/robot_client.hpp"

#include <utility>

#include "common/net/random_id.hpp"
#include "common/rpc/answers.hpp"
#include "common/rpc/client_impl.hpp"

namespace seeker::rpc {
namespace {

Result<api::TileUpdate> join_parts(const Responses& parts) {
  api::TileUpdate all;
  for (const pb::Response& part : parts) {
    Result<api::TileUpdate> one = wire::from_message<api::TileUpdate>(part.get_tiles().update());
    if (!one) {
      return one;
    }
    all.revision = one->revision;
    all.map_epoch = one->map_epoch;
    all.tiles.insert(all.tiles.end(), one->tiles.begin(), one->tiles.end());
  }
  return all;
}

Result<api::MissionAccepted> accepted_in(const pb::StartMissionResponse& response) {
  wire::Check check;
  api::MissionAccepted accepted{response.mission_id(), {}};
  wire::read(response.link_steps(), accepted.link_steps, check);
  return check.ok() ? Result<api::MissionAccepted>(std::move(accepted)) : tl::unexpected<Error>(check.status().error());
}

}  // namespace

RobotClient::RobotClient(std::shared_ptr<Impl> impl) : impl_(std::move(impl)) {}

Result<std::shared_ptr<RobotClient>> RobotClient::connect(const Endpoint& endpoint, ClientParams params) {
  auto impl = std::make_shared<Impl>(endpoint, std::move(params));
  if (const Status opened = impl->open(); !opened) {
    impl->shut_down();
    return tl::unexpected<Error>(opened.error());
  }
  return std::shared_ptr<RobotClient>(new RobotClient(std::move(impl)));
}

RobotClient::~RobotClient() { impl_->shut_down(); }

api::RobotInfo RobotClient::robot() const { return impl_->robot(); }
api::Role RobotClient::role() const { return impl_->role(); }
std::string RobotClient::client_name() const { return impl_->client_name(); }
LinkState RobotClient::link() const { return impl_->link(); }
void RobotClient::close() { impl_->shut_down(); }
void RobotClient::sync_time(const api::Reply<TimeSync>& reply) { impl_->sync_time(reply); }

void RobotClient::get_info(api::Reply<api::RobotInfo> reply) {
  pb::Request request;
  request.mutable_get_info();
  impl_->call(std::move(request), value_answer<api::RobotInfo>(std::move(reply), [](const Responses& r) {
                return wire::from_message<api::RobotInfo>(r.front().get_info().info());
              }));
}

void RobotClient::get_status(api::Reply<api::RobotStatus> reply) {
  pb::Request request;
  request.mutable_get_status();
  impl_->call(std::move(request), value_answer<api::RobotStatus>(std::move(reply), [](const Responses& r) {
                return wire::from_message<api::RobotStatus>(r.front().get_status().robot());
              }));
}

void RobotClient::start_mission(const api::MissionRequest& mission, api::Reply<api::MissionAccepted> reply) {
  pb::Request request;
  wire::write(mission, request.mutable_start_mission()->mutable_mission());
  impl_->call(std::move(request), value_answer<api::MissionAccepted>(std::move(reply), [](const Responses& r) {
                return accepted_in(r.front().start_mission());
              }));
}

void RobotClient::command_mission(api::MissionCommand command, api::Reply<void> reply) {
  pb::Request request;
  request.mutable_command_mission()->set_command(static_cast<pb::MissionCommand>(wire::wire_enum(command)));
  impl_->call(std::move(request), empty_answer(std::move(reply)));
}

void RobotClient::get_mission(api::Reply<api::MissionStatus> reply) {
  pb::Request request;
  request.mutable_get_mission();
  impl_->call(std::move(request), value_answer<api::MissionStatus>(std::move(reply), [](const Responses& r) {
                return wire::from_message<api::MissionStatus>(r.front().get_mission().mission());
              }));
}

void RobotClient::stop(api::Reply<void> reply) {
  pb::Request request;
  request.mutable_stop()->set_once(net::random_id());
  pb::Request copy = request;
  copy.mutable_stop()->set_copy(true);
  impl_->call_urgently(std::move(request), std::move(copy), empty_answer(std::move(reply)));
}

void RobotClient::set_estop(bool engaged, api::Reply<void> reply) {
  pb::Request request;
  request.mutable_set_estop()->set_engaged(engaged);
  if (!engaged) {
    request.mutable_set_estop()->set_release(true);
    impl_->call(std::move(request), empty_answer(std::move(reply)));
    return;
  }
  request.mutable_set_estop()->set_once(net::random_id());
  pb::Request copy = request;
  copy.mutable_set_estop()->set_copy(true);
  impl_->call_urgently(std::move(request), std::move(copy), empty_answer(std::move(reply)));
}

void RobotClient::command_lease(const api::LeaseCommand& command, api::Reply<api::LeaseState> reply) {
  pb::Request request;
  request.mutable_command_lease()->set_action(static_cast<pb::LeaseAction>(wire::wire_enum(command.action)));
  request.mutable_command_lease()->set_intended(command.intended);
  impl_->call(std::move(request), value_answer<api::LeaseState>(std::move(reply), [](const Responses& r) {
                return wire::from_message<api::LeaseState>(r.front().command_lease().lease());
              }));
}

void RobotClient::drive(const api::DriveCommand& command, api::Reply<void> reply) { impl_->drive(command, reply); }

void RobotClient::get_tiles(std::uint64_t since_revision, api::Reply<api::TileUpdate> reply) {
  pb::Request request;
  request.mutable_get_tiles()->set_since_revision(since_revision);
  impl_->call(std::move(request), value_answer<api::TileUpdate>(std::move(reply), join_parts));
}

void RobotClient::get_grid(api::Reply<api::GridReport> reply) {
  pb::Request request;
  request.mutable_get_grid();
  impl_->call(std::move(request), value_answer<api::GridReport>(std::move(reply), [](const Responses& r) {
                return wire::from_message<api::GridReport>(r.front().get_grid().grid());
              }));
}

void RobotClient::get_detections(api::Reply<std::vector<api::Detection>> reply) {
  pb::Request request;
  request.mutable_get_detections();
  impl_->call(std::move(request), value_answer<std::vector<api::Detection>>(std::move(reply), [](const Responses& r) {
                return read_list<api::Detection>(r.front().get_detections().detections(), wire::kMaxDetections);
              }));
}

void RobotClient::get_trajectory(api::Reply<std::vector<api::StampedPose>> reply) {
  pb::Request request;
  request.mutable_get_trajectory();
  impl_->call(std::move(request), value_answer<std::vector<api::StampedPose>>(std::move(reply), [](const Responses& r) {
                return wire::from_message<std::vector<api::StampedPose>>(r.front().get_trajectory().poses());
              }));
}

void RobotClient::grab_image(const std::string& camera, api::Reply<api::ImageFrame> reply) {
  pb::Request request;
  request.mutable_grab_image()->set_camera(wire::clean_text(camera));
  impl_->call(std::move(request), value_answer<api::ImageFrame>(std::move(reply), [](const Responses& r) {
                return wire::from_message<api::ImageFrame>(r.front().grab_image().image());
              }));
}

Result<std::unique_ptr<api::Subscription>> RobotClient::subscribe(const std::vector<api::TopicRequest>& topics,
                                                                  api::UpdateSink sink) {
  return impl_->subscribe(topics, std::move(sink));
}

}  // namespace seeker::rpc
