// An operator on a bad network: commands missions, follows them, stops them, and says how long STOP took. Called by
// peers.sh.

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <iostream>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "common/rpc/robot_client.hpp"
#include "common/rpc/wait.hpp"
#include "tests/support/quantile.hpp"

namespace {

using namespace seeker;
using seeker::testing::quantile;
using Clock = std::chrono::steady_clock;

constexpr Duration kPatience = std::chrono::seconds(60);
constexpr Duration kLoopPeriod = std::chrono::milliseconds(100);
constexpr int kMissions = 20;
constexpr int kMostTries = 20;
constexpr int kStopLinks = 2;

double ms(Duration duration) { return 1e3 * to_seconds(duration); }

/// What the stream of missions has told.
class Followed {
 public:
  void note(const api::UpdatePtr& update) {
    const auto* status = std::get_if<api::MissionStatus>(&update->payload);
    if (status == nullptr) {
      return;
    }
    const std::lock_guard lock(mutex_);
    ++reports_;
    missions_[status->id] = *status;
    changed_.notify_all();
  }
  template <class Holds>
  [[nodiscard]] bool wait(const api::MissionId& id, Holds&& holds) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, kPatience, [&] { return missions_.count(id) > 0 && holds(missions_.at(id)); });
  }
  [[nodiscard]] int reports() const {
    const std::lock_guard lock(mutex_);
    return reports_;
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::map<api::MissionId, api::MissionStatus> missions_;
  int reports_ = 0;
};

Result<std::shared_ptr<rpc::RobotClient>> connect(const rpc::Endpoint& robot, const std::string& bundle,
                                                  int stop_links) {
  rpc::ClientParams params;
  params.client_name = "soak";
  params.stop_links = stop_links;
  params.tls = pki::bundle_in(bundle);
  params.connect_timeout = params.call_timeout = kPatience;
  params.on_link = [](const rpc::LinkEvent& event) {
    std::cout << "  info  the link is " << rpc::to_string(event.state) << ": " << event.why << std::endl;
  };
  Result<std::shared_ptr<rpc::RobotClient>> client = rpc::RobotClient::connect(robot, params);
  for (int k = 1; k < kMostTries && !client; ++k) {
    client = rpc::RobotClient::connect(robot, params);
  }
  return client;
}

/// That of the network: the robot's loop has no part in the answer.
Duration round_trip(rpc::RobotClient& client) {
  std::vector<Duration> all;
  for (int k = 0; k < kMissions; ++k) {
    const auto begin = Clock::now();
    if (rpc::wait<rpc::TimeSync>([&](auto reply) { client.sync_time(std::move(reply)); }, kPatience)) {
      all.push_back(Clock::now() - begin);
    }
  }
  return all.empty() ? kPatience : quantile(all, 0.5);
}

/// A start that is repeated, since the link may be broken just now, is harmless: the mission has an id.
Result<api::MissionAccepted> start(rpc::RobotClient& client, const api::MissionRequest& request) {
  const auto give_up = Clock::now() + kPatience;
  for (;;) {
    auto started = rpc::wait<api::MissionAccepted>([&](auto reply) { client.start_mission(request, std::move(reply)); },
                                                   kPatience);
    if (started || started.error().code != Errc::kLinkLost || Clock::now() > give_up) {
      return started;
    }
    std::this_thread::sleep_for(kLoopPeriod);
  }
}

/// Commands, follows and stops one mission; the time that STOP took.
std::optional<Duration> one_mission(rpc::RobotClient& client, Followed& followed, int number) {
  api::MissionRequest request;
  request.id = "soak-" + std::to_string(number);
  const double away_m = number % 2 == 0 ? 0.0 : 2.0;
  request.task = api::GotoMission{.waypoints = {{away_m, 0.0}}, .final_heading_rad = {}, .keep_out = {}};
  request.link_policy = api::LinkPolicy::kContinue;
  const auto started = start(client, request);
  if (!started) {
    std::cerr << "not started: " << started.error().message << "\n";
    return std::nullopt;
  }
  constexpr double kUnderWay_m = 0.1;
  const auto under_way = [](const api::MissionStatus& mission) {
    return mission.path_length_m > kUnderWay_m || mission.end;
  };
  if (!followed.wait(request.id, under_way)) {
    std::cerr << "no report of the mission under way\n";
    return std::nullopt;
  }
  // Reports come in step with the loop; STOP comes at any of its moments.
  std::this_thread::sleep_for(kLoopPeriod * (number - 1) / kMissions);
  const auto begin = Clock::now();
  const Status stopped = rpc::wait<void>([&](auto reply) { client.stop(std::move(reply)); }, kPatience);
  const Duration took = Clock::now() - begin;
  const bool ended =
      followed.wait(request.id, [](const api::MissionStatus& mission) { return mission.end.has_value(); });
  if (!stopped || !ended) {
    std::cerr << (stopped ? "no report of the end\n" : "not stopped: " + stopped.error().message + "\n");
    return std::nullopt;
  }
  return took;
}

int run(const std::string& address, const std::string& bundle, int stop_links) {
  const Result<rpc::Endpoint> robot = rpc::parse_endpoint(address);
  const auto client = robot ? connect(*robot, bundle, stop_links) : tl::unexpected<Error>(robot.error());
  if (!client) {
    std::cerr << client.error().message << "\n";
    return 1;
  }
  Followed followed;
  const auto stream = (*client)->subscribe({{api::Topic::kMission}, {api::Topic::kEvent}, {api::Topic::kStatus, 2.0}},
                                           [&](const api::UpdatePtr& update) { followed.note(update); });
  const Duration trip = round_trip(**client);
  std::vector<Duration> stops;
  for (int k = 1; k <= kMissions; ++k) {
    if (const auto took = one_mission(**client, followed, k)) {
      stops.push_back(*took);
    }
  }
  const Duration most = trip + kLoopPeriod;
  const auto in_time = std::count_if(stops.begin(), stops.end(), [&](Duration took) { return took <= most; });
  std::cout << "  info  round trip " << ms(trip) << " ms (median of " << kMissions << "); with a period of the "
            << "loop " << ms(most) << " ms\n  info  " << stops.size() << " of " << kMissions << " missions commanded, "
            << "followed by " << followed.reports() << " reports, and stopped\n";
  if (stops.empty()) {
    return 1;
  }
  std::cout << "  info  STOP acknowledged in " << ms(quantile(stops, 0.5)) << " ms (median), "
            << ms(quantile(stops, 1.0)) << " ms at worst; " << in_time << " of them within that time\n";
  return stops.size() == kMissions && in_time >= kMissions - 1 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 && argc != 4) {
    std::cerr << "usage: soak_operator HOST:PORT BUNDLE [STOP_LINKS]\n";
    return 2;
  }
  return run(argv[1], argv[2], argc == 4 ? std::stoi(argv[3]) : kStopLinks);
}
