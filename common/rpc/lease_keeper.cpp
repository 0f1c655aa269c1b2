#include "common/rpc/lease_keeper.hpp"

#include <mutex>
#include <utility>

#include "common/rpc/wait.hpp"

namespace seeker::rpc {
namespace {
/// How often the robot's status is looked at for the owner of the lease.
constexpr double kWatchRate_hz = 5.0;
}  // namespace

struct LeaseKeeper::State : std::enable_shared_from_this<State> {
  State(LeaseKeeperParams p, const std::shared_ptr<api::RobotApi>& r) : params(std::move(p)), robot(r) {}

  LeaseKeeperParams params;
  std::weak_ptr<api::RobotApi> robot;
  std::mutex mutex;
  std::uint64_t epoch = 0;
  bool held = false;
  bool refreshing = false;

  void on_status(const api::RobotStatus& status) {
    {
      const std::lock_guard lock(mutex);
      const bool owns = status.lease.owner == params.client_name;
      const bool ours = owns && status.lease.epoch == epoch && !status.lease.stale;
      // A status from before the acquisition does not count.
      if (!held || ours || refreshing || status.lease.epoch < epoch) {
        return;
      }
      refreshing = owns && status.lease.stale;
      held = refreshing;
    }
    const auto alive = robot.lock();
    if (held_still() && alive) {
      alive->command_lease(
          {api::LeaseAction::kAcquire, false},
          [self = shared_from_this()](const Result<api::LeaseState>& lease) { self->refreshed(lease); });
    } else if (params.on_lost) {
      params.on_lost(status.lease);
    }
  }
  /// The robot did not hear this client for a while, and nobody has taken the lease meanwhile.
  void refreshed(const Result<api::LeaseState>& lease) {
    {
      const std::lock_guard lock(mutex);
      refreshing = false;
      held = held && lease && lease->owner == params.client_name;
      if (held) {
        epoch = lease->epoch;
        return;
      }
    }
    if (params.on_lost) {
      params.on_lost(lease ? *lease : api::LeaseState{});
    }
  }
  [[nodiscard]] bool held_still() {
    const std::lock_guard lock(mutex);
    return held;
  }
};

LeaseKeeper::LeaseKeeper(std::shared_ptr<api::RobotApi> robot, std::shared_ptr<State> state)
    : robot_(std::move(robot)), state_(std::move(state)) {}

Result<std::unique_ptr<LeaseKeeper>> LeaseKeeper::acquire(std::shared_ptr<api::RobotApi> robot,
                                                          LeaseKeeperParams params) {
  const Duration timeout = params.timeout;
  const api::LeaseCommand command{params.take_over ? api::LeaseAction::kTakeOver : api::LeaseAction::kAcquire,
                                  params.take_over};
  const Result<api::LeaseState> lease = wait<api::LeaseState>(
      [&](api::Reply<api::LeaseState> reply) { robot->command_lease(command, std::move(reply)); }, timeout);
  if (!lease) {
    return tl::unexpected<Error>(lease.error());
  }
  auto state = std::make_shared<State>(std::move(params), robot);
  state->epoch = lease->epoch;
  state->held = true;
  std::unique_ptr<LeaseKeeper> keeper(new LeaseKeeper(std::move(robot), state));
  auto watch = keeper->robot_->subscribe({{api::Topic::kStatus, kWatchRate_hz, 0}}, [state](const api::UpdatePtr& u) {
    if (const auto* status = std::get_if<api::RobotStatus>(&u->payload)) {
      state->on_status(*status);
    }
  });
  if (!watch) {
    return tl::unexpected<Error>(watch.error());
  }
  keeper->watch_ = std::move(*watch);
  return keeper;
}

LeaseKeeper::~LeaseKeeper() {
  const Status ignored = release();  // the link may be gone; the robot frees the lease of a lost client itself
  (void)ignored;
}

std::uint64_t LeaseKeeper::epoch() const {
  const std::lock_guard lock(state_->mutex);
  return state_->epoch;
}

bool LeaseKeeper::held() const {
  const std::lock_guard lock(state_->mutex);
  return state_->held;
}

Status LeaseKeeper::release() {
  {
    const std::lock_guard lock(state_->mutex);
    if (!std::exchange(state_->held, false)) {
      return {};
    }
  }
  const Result<api::LeaseState> lease = wait<api::LeaseState>(
      [&](api::Reply<api::LeaseState> reply) {
        robot_->command_lease({api::LeaseAction::kRelease, false}, std::move(reply));
      },
      state_->params.timeout);
  return lease ? Status{} : Status(tl::unexpected<Error>(lease.error()));
}

}  // namespace seeker::rpc
