// Throughput of the frame codec, and what it costs to send pose and tiles to 1, 10 and 100 clients over loopback.
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "common/log/log.hpp"
#include "common/rpc/robot_client.hpp"
#include "common/rpc/wait.hpp"
#include "common/wire/frame.hpp"
#include "server/net/server.hpp"
#include "tests/support/fake_robot.hpp"
#include "tests/support/quantile.hpp"

namespace {

using namespace seeker;  // NOLINT: a benchmark is one small program
using Clock = std::chrono::steady_clock;

void frame_codec(benchmark::State& state) {
  const auto size = static_cast<std::size_t>(state.range(0));
  const wire::OutFrame frame = wire::make_frame(std::string(size, 'x'));
  const std::string bytes = frame.head + *frame.body;
  wire::FrameDecoder decoder;
  for (auto _ : state) {
    benchmark::DoNotOptimize(decoder.feed(bytes));
    benchmark::DoNotOptimize(decoder.next());
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * bytes.size()));
}
BENCHMARK(frame_codec)->Arg(64)->Arg(4096)->Arg(1 << 20);

/// Counts arrivals of one round at all clients and keeps their delays.
struct Arrivals {
  std::mutex mutex;
  std::condition_variable changed;
  std::size_t count = 0;
  Clock::time_point sent;
  std::vector<double> delays_ms;

  void arrived() {
    const std::lock_guard lock(mutex);
    delays_ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - sent).count());
    ++count;
    changed.notify_one();
  }
};

api::TileUpdate changed_tiles(std::uint64_t revision) {
  api::TileUpdate update{revision, 1, {}};
  for (int k = 0; k < 4; ++k) {
    OccupancyTile tile;
    tile.index = {k, 0};
    tile.revision = revision;
    for (std::size_t c = 0; c < tile.cells.size(); ++c) {
      tile.cells[c] = static_cast<std::uint8_t>((c * revision) % 97 < 5 ? 200 : 20);
    }
    update.tiles.push_back(tile);
  }
  return update;
}

/// One round: a status and four tiles published, received by all clients.
void fan_out(benchmark::State& state) {
  const log::ScopedSink quiet([](const log::Line&) {});
  const auto clients = static_cast<std::size_t>(state.range(0));
  testing::FakeRobotHost robot;
  server_net::ServerParams params;
  params.port = 0;
  server_net::Server server(robot, params);
  const auto port = server.start();
  Arrivals arrivals;
  std::vector<std::shared_ptr<rpc::RobotClient>> robots;
  std::vector<std::unique_ptr<api::Subscription>> subscriptions;
  for (std::size_t k = 0; k < clients; ++k) {
    rpc::ClientParams p;
    p.client_name = "bench-" + std::to_string(k);
    robots.push_back(*rpc::RobotClient::connect({"127.0.0.1", *port}, p));
    subscriptions.push_back(*robots.back()->subscribe({{api::Topic::kStatus, 0.0, 0}, {api::Topic::kTiles, 0.0, 0}},
                                                      [&](const api::UpdatePtr&) { arrivals.arrived(); }));
    (void)rpc::wait<api::RobotInfo>([&](auto reply) { robots.back()->get_info(reply); }, std::chrono::seconds(10));
  }
  const std::uint64_t bytes_before = server.stats().bytes_sent;
  const api::RobotStatus status = robot.values().status;
  std::uint64_t revision = 0;
  for (auto _ : state) {
    {
      const std::lock_guard lock(arrivals.mutex);
      arrivals.count = 0;
      arrivals.sent = Clock::now();
    }
    robot.publish(api::Topic::kStatus, robot_time_s(1.0), status);
    robot.publish(api::Topic::kTiles, robot_time_s(1.0), changed_tiles(++revision));
    std::unique_lock lock(arrivals.mutex);
    arrivals.changed.wait(lock, [&] { return arrivals.count >= 2 * clients; });
  }
  state.counters["p50_ms"] = testing::quantile(arrivals.delays_ms, 0.50);
  state.counters["p99_ms"] = testing::quantile(arrivals.delays_ms, 0.99);
  state.counters["bytes_per_client_round"] = static_cast<double>(server.stats().bytes_sent - bytes_before) /
                                             static_cast<double>(state.iterations()) / static_cast<double>(clients);
  subscriptions.clear();
  robots.clear();
}
BENCHMARK(fan_out)->Arg(1)->Arg(10)->Arg(100)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
