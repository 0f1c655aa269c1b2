#include "tests/bench/link/load.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <fstream>
#include <future>
#include <iostream>
#include <mutex>

#include "common/core/rng.hpp"
#include "tests/bench/link/latencies.hpp"
#include "tests/bench/link/options.hpp"
#include "tests/bench/link/process_figures.hpp"
#include "tests/bench/link/traffic.hpp"
#include "tests/support/net/await.hpp"
#include "tests/support/net/chaos_proxy.hpp"

namespace seeker::link_bench {
namespace {

/// Not the period of states, so that commands come at any time between two of them.
constexpr std::chrono::milliseconds kDrivePeriod{47};
constexpr std::chrono::seconds kAnswerLimit{10};
constexpr std::chrono::seconds kFreshLimit{30};
/// Before a link is cut it must have carried so many states: what begins anew in a connection is over then.
constexpr int kStatesBetweenCuts = 10;
constexpr std::uint64_t kSeed = 1;  ///< of the moments of the cuts
constexpr double kPercent = 100.0;

Status too_late(const std::string& what) { return fail(Errc::kTimeout, what + " did not come"); }

/// Waits for moments of the steady clock.
class Pace {
 public:
  void wait_until(RobotTime due) {
    std::unique_lock lock(mutex_);
    const std::chrono::steady_clock::time_point at(due.time_since_epoch());
    never_.wait_until(lock, at, [at] { return std::chrono::steady_clock::now() >= at; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable never_;
};

/// The newest state of one client, for a thread that waits for one that is new enough.
class NewestState {
 public:
  void arrived(RobotTime stamp) {
    const std::lock_guard lock(mutex_);
    stamp_ = stamp;
    at_ = now();
    ++count_;
    changed_.notify_all();
  }
  /// When the first state of after `cut` came.
  [[nodiscard]] std::optional<RobotTime> wait_for_one_after(RobotTime cut) {
    std::unique_lock lock(mutex_);
    const bool came = changed_.wait_for(lock, kFreshLimit, [&] { return stamp_ > cut; });
    return came ? std::optional(at_) : std::nullopt;
  }
  [[nodiscard]] bool wait_for(int more) {
    std::unique_lock lock(mutex_);
    const int goal = count_ + more;
    return changed_.wait_for(lock, kFreshLimit, [&] { return count_ >= goal; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  RobotTime stamp_{};
  RobotTime at_{};
  int count_ = 0;
};

api::DriveCommand command_of_now() {
  api::DriveCommand command;
  command.ttl = api::kMaxDriveTtl;
  command.sent = now();
  return command;
}

/// One command after the other, each answered before the next.
Status drive_until(RobotTime end, Client& client, Latencies& answers) {
  Pace pace;
  for (RobotTime due = now() + kDrivePeriod; due < end; due += kDrivePeriod) {
    pace.wait_until(due);
    const RobotTime sent = now();
    auto answer = std::make_shared<std::promise<Status>>();
    std::future<Status> answered = answer->get_future();
    client.drive(command_of_now(), [answer](Status status) { answer->set_value(std::move(status)); });
    if (answered.wait_for(kAnswerLimit) != std::future_status::ready) {
      return too_late("the answer to a command");
    }
    if (Status obeyed = answered.get(); !obeyed) {
      return obeyed;
    }
    answers.add(now() - sent);
  }
  return {};
}

void print_costs(const ProcessFigures& before, const ProcessFigures& after, double passed_s) {
  std::cout << "host_cpu_percent " << kPercent * (after.processor_s - before.processor_s) / passed_s << '\n'
            << "host_waited_percent " << kPercent * (after.waited_s - before.waited_s) / passed_s << '\n'
            << "host_resident_kib " << after.resident_kib << '\n';
}

Status measure(const LoadOptions& options, const Connect& connect) {
  Latencies states;
  Latencies answers;
  NewestState newest;
  std::atomic<bool> counting{false};
  const ClientWish wish{"measuring",
                        pki::bundle_in(options.bundle),
                        options.port,
                        true,
                        {api::Topic::kStatus},
                        [&](api::Topic, RobotTime stamp) {
                          const RobotTime arrived = now();
                          if (counting) {
                            states.add(arrived - stamp);
                          }
                          newest.arrived(stamp);
                        }};
  const Result<std::unique_ptr<Client>> client = connect(wish);
  if (!client) {
    return tl::unexpected<Error>(client.error());
  }
  if (!newest.wait_for(1)) {
    return too_late("a state");
  }
  Pace().wait_until(now() + options.warm_up);
  const ProcessFigures before = figures_of(options.host);
  const RobotTime start = now();
  counting = true;
  if (Status driven = drive_until(start + options.measured, **client, answers); !driven) {
    return driven;
  }
  counting = false;
  print_costs(before, figures_of(options.host), to_seconds(now() - start));
  if (Status written = states.write(options.states); !written) {
    return written;
  }
  return answers.write(options.drives);
}

Status measure_cuts(const LoadOptions& options, const Connect& connect) {
  testing::ChaosProxy proxy(options.port);
  Pace pace;
  Rng rng(kSeed);
  Latencies fresh;
  NewestState newest;
  const ClientWish wish{
      "cut", pki::bundle_in(options.bundle), proxy.port(),
      false, {api::Topic::kStatus},          [&](api::Topic, RobotTime stamp) { newest.arrived(stamp); }};
  const Result<std::unique_ptr<Client>> client = connect(wish);
  if (!client) {
    return tl::unexpected<Error>(client.error());
  }
  for (std::size_t k = 0; k < options.cuts; ++k) {
    if (!newest.wait_for(kStatesBetweenCuts)) {
      return too_late("a state");
    }
    pace.wait_until(now() + seconds(rng.uniform(0.0, to_seconds(kStatusPeriod))));
    const RobotTime cut = now();
    proxy.cut();
    const std::optional<RobotTime> at = newest.wait_for_one_after(cut);
    if (!at) {
      return too_late("a state after cut " + std::to_string(k + 1));
    }
    fresh.add(*at - cut);
  }
  return fresh.write(options.states);
}

/// Clients with video, and what they have received.
class Crowd {
 public:
  Status connect(const LoadOptions& options, const Connect& connect) {
    images_ = std::vector<std::atomic<std::uint64_t>>(options.clients);
    for (std::size_t k = 0; k < options.clients; ++k) {
      const ClientWish wish{
          "video-" + std::to_string(k),
          pki::bundle_in(options.bundle),
          options.port,
          false,
          {api::Topic::kStatus, api::Topic::kImage},
          [this, k](api::Topic topic, RobotTime) { images_[k] += topic == api::Topic::kImage ? 1 : 0; }};
      Result<std::unique_ptr<Client>> client = connect(wish);
      if (!client) {
        return tl::unexpected<Error>(client.error());
      }
      clients_.push_back(std::move(*client));
    }
    return testing::eventually([this] { return fewest() > 0; }) ? Status() : too_late("the first image of each client");
  }
  /// Of the client that has got the fewest.
  [[nodiscard]] std::uint64_t fewest() const { return *std::min_element(images_.begin(), images_.end()); }

 private:
  std::vector<std::atomic<std::uint64_t>> images_;
  std::vector<std::unique_ptr<Client>> clients_;
};

Status hold(const LoadOptions& options, const Connect& connect) {
  Crowd crowd;
  if (Status connected = crowd.connect(options, connect); !connected) {
    return connected;
  }
  const std::uint64_t bytes_before = bytes_received_from(options.port);
  const std::uint64_t images_before = crowd.fewest();
  const RobotTime start = now();
  std::ofstream(options.ready_file) << "ready\n";
  wait_for_end();
  const double passed_s = to_seconds(now() - start);
  std::cout << "client_bytes_per_s "
            << static_cast<double>(bytes_received_from(options.port) - bytes_before) / passed_s /
                   static_cast<double>(options.clients)
            << '\n'
            << "client_images_per_s " << static_cast<double>(crowd.fewest() - images_before) / passed_s << '\n';
  return {};
}

}  // namespace

int run_load(int argc, char** argv, const Connect& connect) {
  const LoadOptions options = read_load_options(argc, argv);
  hold_back_end();
  const Status done = options.clients > 0 ? hold(options, connect)
                      : options.cuts > 0  ? measure_cuts(options, connect)
                                          : measure(options, connect);
  if (!done) {
    std::cerr << argv[0] << ": " << done.error().message << '\n';
    return 1;
  }
  return 0;
}

}  // namespace seeker::link_bench
