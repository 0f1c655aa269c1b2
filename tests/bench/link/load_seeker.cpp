// Clients of `./run bench link` over Seeker's own link.
#include "common/rpc/robot_client.hpp"
#include "common/rpc/wait.hpp"
#include "tests/bench/link/load.hpp"

namespace seeker::link_bench {
namespace {

constexpr std::chrono::seconds kAnswerLimit{10};

class SeekerClient final : public Client {
 public:
  explicit SeekerClient(std::shared_ptr<rpc::RobotClient> robot) : robot_(std::move(robot)) {}

  /// Compares the clocks, as is due before commands with a time, takes the lease and subscribes.
  Status start(const ClientWish& wish) {
    const auto compared = rpc::wait<rpc::TimeSync>([&](auto reply) { robot_->sync_time(reply); }, kAnswerLimit);
    if (!compared) {
      return tl::unexpected<Error>(compared.error());
    }
    if (wish.drives) {
      const auto lease = rpc::wait<api::LeaseState>(
          [&](auto reply) {
            robot_->command_lease({api::LeaseAction::kAcquire, false}, reply);
          },
          kAnswerLimit);
      if (!lease) {
        return tl::unexpected<Error>(lease.error());
      }
      epoch_ = lease->epoch;
    }
    std::vector<api::TopicRequest> topics;
    for (const api::Topic topic : wish.topics) {
      topics.push_back({topic, 0.0, 0});
    }
    auto subscription = robot_->subscribe(topics, [on_update = wish.on_update](const api::UpdatePtr& update) {
      on_update(update->topic, update->stamp);
    });
    if (!subscription) {
      return tl::unexpected<Error>(subscription.error());
    }
    subscription_ = std::move(*subscription);
    return {};
  }

  void drive(const api::DriveCommand& command, std::function<void(Status)> answered) override {
    api::DriveCommand leased = command;
    leased.lease_epoch = epoch_;
    robot_->drive(leased, std::move(answered));
  }

 private:
  std::shared_ptr<rpc::RobotClient> robot_;
  std::unique_ptr<api::Subscription> subscription_;
  std::uint64_t epoch_ = 0;
};

Result<std::unique_ptr<Client>> connect(const ClientWish& wish) {
  rpc::ClientParams params;
  params.client_name = wish.name;
  params.tls = wish.bundle;
  params.connect_timeout = kAnswerLimit;
  auto robot = rpc::RobotClient::connect({"127.0.0.1", wish.port}, params);
  if (!robot) {
    return tl::unexpected<Error>(robot.error());
  }
  auto client = std::make_unique<SeekerClient>(std::move(*robot));
  if (const Status started = client->start(wish); !started) {
    return tl::unexpected<Error>(started.error());
  }
  return std::unique_ptr<Client>(std::move(client));
}

}  // namespace
}  // namespace seeker::link_bench

int main(int argc, char** argv) { return seeker::link_bench::run_load(argc, argv, seeker::link_bench::connect); }
