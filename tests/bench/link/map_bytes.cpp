// Counts what a client with map and status receives from a robot, against whole maps at the same moments, for
// `./run bench link`.
#include <algorithm>
#include <condition_variable>
#include <iostream>
#include <map>
#include <mutex>

#include <CLI/CLI.hpp>

#include "common/rpc/robot_client.hpp"
#include "common/rpc/wait.hpp"
#include "common/wire/envelope.hpp"
#include "tests/bench/link/process_figures.hpp"

namespace seeker::link_bench {
namespace {

constexpr std::chrono::seconds kAnswerLimit{10};
constexpr double kSecondsPerMinute = 60.0;

struct Options {
  std::filesystem::path bundle;
  std::uint16_t port = 0;
  double seconds = 60.0;  ///< robot time
  bool explore = false;
};

Options read_options(int argc, char** argv) {
  CLI::App app("Counts the bytes of a robot's map, for ./run bench link.");
  Options out;
  app.add_option("--bundle", out.bundle, "Folder with the operator's certificates")->required();
  app.add_option("--port", out.port, "Of seekerd")->required();
  app.add_option("--seconds", out.seconds, "Robot time that is counted")->check(CLI::PositiveNumber);
  app.add_flag("--explore", out.explore, "Start an exploration");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error));
  }
  return out;
}

double encoded(api::Topic topic, api::Payload payload) {
  return static_cast<double>(wire::encode_body({topic, 1, 0, RobotTime(), std::move(payload)})->size());
}

/// The tiles a client has, and what all of them would take.
class WholeTiles {
 public:
  void take(const api::TileUpdate& update) {
    if (update.map_epoch != epoch_) {
      epoch_ = update.map_epoch;
      bytes_.clear();
    }
    for (const OccupancyTile& tile : update.tiles) {
      bytes_[tile.index] = static_cast<double>(wire::encode_tile(tile)->size());
    }
  }
  [[nodiscard]] double packed_bytes() const {
    double sum = 0.0;
    for (const auto& [index, bytes] : bytes_) {
      sum += bytes;
    }
    return sum;
  }
  /// As one grid of a byte a cell, which is how maps are commonly sent: its cells alone.
  [[nodiscard]] double grid_bytes() const {
    if (bytes_.empty()) {
      return 0.0;
    }
    CellIndex low = bytes_.begin()->first;
    CellIndex high = low;
    for (const auto& [index, bytes] : bytes_) {
      low = {std::min(low.i, index.i), std::min(low.j, index.j)};
      high = {std::max(high.i, index.i), std::max(high.j, index.j)};
    }
    const double tiles = static_cast<double>(high.i - low.i + 1) * static_cast<double>(high.j - low.j + 1);
    return tiles * static_cast<double>(kTileSide_cells) * static_cast<double>(kTileSide_cells);
  }

 private:
  std::map<CellIndex, double> bytes_;
  std::uint32_t epoch_ = 0;
};

/// The segments a client has.
class WholeSegments {
 public:
  void take(const api::SegmentUpdate& update) {
    if (update.full) {
      segments_.clear();
    }
    for (const MapSegment& segment : update.changed) {
      segments_[segment.id] = segment;
    }
    for (const std::uint64_t id : update.removed) {
      segments_.erase(id);
    }
  }
  [[nodiscard]] double bytes() const {
    api::SegmentUpdate all{1, 0, true, {}, {}};
    for (const auto& [id, segment] : segments_) {
      all.changed.push_back(segment);
    }
    return encoded(api::Topic::kSegments, all);
  }

 private:
  std::map<std::uint64_t, MapSegment> segments_;
};

/// Sums over all updates. take() is called on the client's thread.
class Counter {
 public:
  void take(const api::Update& update) {
    const std::lock_guard lock(mutex_);
    first_ = first_ ? first_ : update.stamp;
    last_ = std::max(last_, update.stamp);
    const double bytes = encoded(update.topic, update.payload);
    if (const auto* tiles = std::get_if<api::TileUpdate>(&update.payload)) {
      ++tile_updates_;
      tiles_ += bytes;
      whole_tiles_.take(*tiles);
      packed_ += whole_tiles_.packed_bytes();
      grids_ += whole_tiles_.grid_bytes();
    } else if (const auto* segments = std::get_if<api::SegmentUpdate>(&update.payload)) {
      segments_ += bytes;
      whole_segments_.take(*segments);
      all_segments_ += whole_segments_.bytes();
    } else if (const auto* mission = std::get_if<api::MissionStatus>(&update.payload)) {
      ended_ = mission->end.has_value();
    } else {
      states_ += bytes;
    }
    changed_.notify_all();
  }
  /// What the client had before it subscribed.
  void begin_with(const api::TileUpdate& tiles) {
    const std::lock_guard lock(mutex_);
    whole_tiles_.take(tiles);
  }
  void wait_for(double robot_s) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return ended_ || passed_s() >= robot_s; });
  }
  void print(std::uint64_t received) const {
    const std::lock_guard lock(mutex_);
    const double minutes = passed_s() / kSecondsPerMinute;
    const auto line = [&](const char* name, double bytes) { std::cout << name << ' ' << bytes / minutes << '\n'; };
    std::cout << "robot_minutes " << minutes << '\n';
    line("tile_updates", tile_updates_);
    line("received", static_cast<double>(received));
    line("states", states_);
    line("tiles", tiles_);
    line("segments", segments_);
    line("whole_tiles", packed_);
    line("whole_grids", grids_);
    line("whole_segments", all_segments_);
  }

 private:
  [[nodiscard]] double passed_s() const { return first_ ? to_seconds(last_ - *first_) : 0.0; }

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<RobotTime> first_;
  RobotTime last_{};
  bool ended_ = false;
  WholeTiles whole_tiles_;
  WholeSegments whole_segments_;
  double tile_updates_ = 0.0;
  double tiles_ = 0.0;
  double segments_ = 0.0;
  double states_ = 0.0;
  double packed_ = 0.0;
  double grids_ = 0.0;
  double all_segments_ = 0.0;
};

Status count(const Options& options) {
  rpc::ClientParams params;
  params.client_name = "map";
  params.tls = pki::bundle_in(options.bundle);
  const auto robot = rpc::RobotClient::connect({"127.0.0.1", options.port}, params);
  if (!robot) {
    return tl::unexpected<Error>(robot.error());
  }
  Counter counter;
  const auto tiles = rpc::wait<api::TileUpdate>([&](auto reply) { (*robot)->get_tiles(0, reply); }, kAnswerLimit);
  if (!tiles) {
    return tl::unexpected<Error>(tiles.error());
  }
  counter.begin_with(*tiles);
  const std::uint64_t before = bytes_received_from(options.port);
  const auto subscription = (*robot)->subscribe({{api::Topic::kStatus, 0.0, 0},
                                                 {api::Topic::kTiles, 0.0, 0},
                                                 {api::Topic::kSegments, 0.0, 0},
                                                 {api::Topic::kMission, 0.0, 0}},
                                                [&](const api::UpdatePtr& update) { counter.take(*update); });
  if (!subscription) {
    return tl::unexpected<Error>(subscription.error());
  }
  if (options.explore) {
    api::MissionRequest request;
    request.id = "bench";
    request.task = api::ExploreMission{};
    const auto accepted =
        rpc::wait<api::MissionAccepted>([&](auto reply) { (*robot)->start_mission(request, reply); }, kAnswerLimit);
    if (!accepted) {
      return tl::unexpected<Error>(accepted.error());
    }
  }
  counter.wait_for(options.seconds);
  counter.print(bytes_received_from(options.port) - before);
  return {};
}

}  // namespace
}  // namespace seeker::link_bench

int main(int argc, char** argv) {
  const seeker::Status counted = seeker::link_bench::count(seeker::link_bench::read_options(argc, argv));
  if (!counted) {
    std::cerr << argv[0] << ": " << counted.error().message << '\n';
    return 1;
  }
  return 0;
}
