// A whole robot behind its server, with an estimator whose map the test writes: saving, restarting, loading, streaming.

#include <condition_variable>
#include <filesystem>
#include <map>
#include <mutex>

#include <unistd.h>

#include <gtest/gtest.h>

#include "common/files/files.hpp"
#include "common/log/log.hpp"
#include "common/rpc/robot_client.hpp"
#include "common/rpc/wait.hpp"
#include "tests/support/maps/assembly_with_map.hpp"
#include "tests/support/maps/random_map.hpp"
#include "tests/support/served_robot.hpp"

namespace seeker::testing {
namespace {

constexpr std::chrono::seconds kLimit{30};

/// One run of a robot's program.
class ProgramRun {
 public:
  explicit ProgramRun(const std::filesystem::path& maps, const app::RobotOptions& options = sim_robot_options())
      : robot_(options, assemble_with_map(options, state), on_port(0), maps) {
    rpc::ClientParams client;
    client.client_name = "tester";
    client.connect_timeout = client.call_timeout = kLimit;
    client_ = rpc::RobotClient::connect({"127.0.0.1", robot_.port()}, client).value();
  }
  ProgramRun(const ProgramRun&) = delete;
  ProgramRun& operator=(const ProgramRun&) = delete;
  ~ProgramRun() { client_->close(); }

  [[nodiscard]] api::RobotApi& robot() { return *client_; }
  template <class T, class Call>
  [[nodiscard]] Result<T> ask(Call&& call) {
    return rpc::wait<T>(std::forward<Call>(call), kLimit);
  }
  [[nodiscard]] Result<api::MapSummary> save(const std::string& name, bool replace = false) {
    return ask<api::MapSummary>([&](auto reply) { robot().save_map(name, replace, std::move(reply)); });
  }
  [[nodiscard]] Result<api::MapSummary> load(const std::string& name, api::MapUse use) {
    return ask<api::MapSummary>([&](auto reply) { robot().load_map(name, use, std::move(reply)); });
  }
  [[nodiscard]] api::RobotStatus status() {
    return ask<api::RobotStatus>([&](auto reply) { robot().get_status(std::move(reply)); }).value();
  }
  /// Asks until the robot does not look for its place any more.
  api::RobotStatus found() {
    for (;;) {
      const api::RobotStatus now = status();
      if (!now.line_map->relocalising) {
        return now;
      }
    }
  }

  std::shared_ptr<FakeMapState> state = std::make_shared<FakeMapState>();

 private:
  ServedRobot robot_;
  std::shared_ptr<rpc::RobotClient> client_;
};

class MapAsset : public ::testing::Test {
 protected:
  MapAsset() {
    std::string name = (std::filesystem::temp_directory_path() / "seeker-maps-XXXXXX").string();
    EXPECT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  ~MapAsset() override { std::filesystem::remove_all(folder_); }

  static void write_room(ProgramRun& run) {
    const std::lock_guard lock(run.state->mutex);
    run.state->map = room_map();
    run.state->changed();
  }
  std::vector<std::uint8_t> bytes_of(const std::string& name) const {
    return files::read_file(folder_ / (name + ".seekermap"), std::size_t{1} << 20U).value();
  }

  std::filesystem::path folder_;
  log::ScopedSink quiet_{[](const log::Line&) {}};
};

TEST_F(MapAsset, SavedMapIsThereInTheNextRunAndLocalisingLeavesItsFileAlone) {
  {
    ProgramRun first(folder_);
    write_room(first);
    const Result<api::MapSummary> saved = first.save("office");
    ASSERT_TRUE(saved) << saved.error().message;
    EXPECT_EQ(saved->segments, 4U);
    EXPECT_EQ(saved->robot_id, "r1");
    EXPECT_EQ(first.status().line_map->name, "office");
    EXPECT_TRUE(first.save("office")) << "a map grows under its own name";
  }
  const std::vector<std::uint8_t> before = bytes_of("office");
  ProgramRun second(folder_);
  {
    const std::lock_guard lock(second.state->mutex);
    second.state->found_at = {1.0, 0.5, 0.2};
  }
  const Result<api::MapSummary> loaded = second.load("office", api::MapUse::kLocalise);
  ASSERT_TRUE(loaded) << loaded.error().message;
  const api::RobotStatus status = second.found();
  EXPECT_EQ(status.pose.quality, LocalisationQuality::kLocalised);
  EXPECT_NEAR(status.pose.map_T_base.x_m, 1.0, 0.1);
  EXPECT_EQ(status.pose.map_epoch, 1U) << "another map: older tiles are void";
  EXPECT_EQ(status.line_map->use, api::MapUse::kLocalise);
  {
    const std::lock_guard lock(second.state->mutex);
    EXPECT_EQ(second.state->map, room_map());
    EXPECT_EQ(second.state->use, slam::MapUse::kLocalise);
  }
  const Result<api::MapSummary> refused = second.save("office", true);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::kRefused);
  EXPECT_FALSE(second.ask<void>([&](auto reply) { second.robot().delete_map("office", std::move(reply)); }));
  EXPECT_TRUE(second.save("office-copy"));
  EXPECT_EQ(bytes_of("office"), before);
  const auto list =
      second.ask<std::vector<api::MapSummary>>([&](auto reply) { second.robot().list_maps(std::move(reply)); });
  ASSERT_TRUE(list);
  EXPECT_EQ(list->size(), 2U);
}

TEST_F(MapAsset, RobotThatCannotBeFoundIsLostWithTheCauseAndRefusesMissions) {
  ProgramRun run(folder_);
  write_room(run);
  {
    const std::lock_guard lock(run.state->mutex);
    run.state->lost_because = "no place of the map looks like this";
  }
  ASSERT_TRUE(run.ask<void>([&](auto reply) { run.robot().relocalise(std::nullopt, std::move(reply)); }));
  const api::RobotStatus status = run.found();
  EXPECT_EQ(status.pose.quality, LocalisationQuality::kLost);
  EXPECT_EQ(status.pose.cause, "no place of the map looks like this");
  api::MissionRequest mission;
  mission.id = "go";
  mission.task = api::GotoMission{.waypoints = {Point2(1, 0)}, .final_heading_rad = std::nullopt, .keep_out = {}};
  const auto started =
      run.ask<api::MissionAccepted>([&](auto reply) { run.robot().start_mission(mission, std::move(reply)); });
  ASSERT_FALSE(started);
  EXPECT_EQ(started.error().code, Errc::kNotReady);
  EXPECT_NE(started.error().message.find("seeker relocalise"), std::string::npos) << started.error().message;
}

TEST_F(MapAsset, FilesOfClientsAreCheckedBeforeTheyAreKept) {
  ProgramRun run(folder_);
  write_room(run);
  ASSERT_TRUE(run.save("office"));
  auto file =
      run.ask<std::vector<std::uint8_t>>([&](auto reply) { run.robot().download_map("office", std::move(reply)); });
  ASSERT_TRUE(file);
  EXPECT_EQ(*file, bytes_of("office"));
  const auto upload = [&](const api::MapUpload& what) {
    return run.ask<api::MapSummary>([&](auto reply) { run.robot().upload_map(what, std::move(reply)); });
  };
  EXPECT_EQ(upload({"copy", *file, false, true})->segments, 4U);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "copy.seekermap")) << "it was only checked";
  EXPECT_EQ(upload({"copy", *file, false, false})->name, "copy");
  EXPECT_EQ(upload({"copy", *file, false, false})->name, "copy") << "the same map again";
  {
    const std::lock_guard lock(run.state->mutex);
    run.state->map = room_map(9.0);
    run.state->changed();
  }
  ASSERT_TRUE(run.save("other"));
  EXPECT_EQ(upload({"other", *file, false, false}).error().code, Errc::kRefused);
  file->back() ^= 1U;
  const Result<api::MapSummary> damaged = upload({"third", *file, false, false});
  ASSERT_FALSE(damaged);
  EXPECT_EQ(damaged.error().code, Errc::kCorrupt);
  EXPECT_EQ(run.load("third", api::MapUse::kContinue).error().code, Errc::kNotFound);
  EXPECT_EQ(run.save("Not A Name").error().code, Errc::kInvalidArgument);
}

TEST_F(MapAsset, SubscriberGetsTheWholeMapThenWhatChanges) {
  ProgramRun run(folder_);
  write_room(run);
  std::mutex mutex;
  std::condition_variable changed;
  std::map<std::uint64_t, MapSegment> seen;
  const auto subscription = run.robot().subscribe({{api::Topic::kSegments, 0.0, 0}}, [&](const api::UpdatePtr& update) {
    const auto& segments = std::get<api::SegmentUpdate>(update->payload);
    const std::lock_guard lock(mutex);
    if (segments.full) {
      seen.clear();
    }
    for (const std::uint64_t id : segments.removed) {
      seen.erase(id);
    }
    for (const MapSegment& segment : segments.changed) {
      seen[segment.id] = segment;
    }
    changed.notify_all();
  });
  ASSERT_TRUE(subscription);
  const auto wait_for = [&](auto condition) {
    std::unique_lock lock(mutex);
    return changed.wait_for(lock, kLimit, condition);
  };
  // Robot time, and with it the period of publications, passes while the robot looks for its place.
  const auto let_time_pass = [&] {
    {
      const std::lock_guard lock(run.state->mutex);
      run.state->scans_to_search = 20;
    }
    ASSERT_TRUE(run.ask<void>([&](auto reply) { run.robot().relocalise(std::nullopt, std::move(reply)); }));
    run.found();
  };
  let_time_pass();
  ASSERT_TRUE(wait_for([&] { return seen.size() == 4; }));
  {
    const std::lock_guard lock(run.state->mutex);
    run.state->map.segments.erase(run.state->map.segments.begin());
    run.state->map.segments.front().length_m = 1.5;
    run.state->changed();
  }
  let_time_pass();
  EXPECT_TRUE(wait_for([&] { return seen.size() == 3 && seen.contains(2) && seen[2].length_m == 1.5; }));
  const auto all = run.ask<api::SegmentUpdate>([&](auto reply) { run.robot().get_segments(0, std::move(reply)); });
  ASSERT_TRUE(all);
  EXPECT_TRUE(all->full);
  EXPECT_EQ(all->changed.size(), 3U);
}

TEST(MapAssetWithoutFolder, SavingSaysWhatIsMissing) {
  const log::ScopedSink quiet([](const log::Line&) {});
  ProgramRun run({});
  const Result<api::MapSummary> saved = run.save("office");
  ASSERT_FALSE(saved);
  EXPECT_EQ(saved.error().code, Errc::kNotReady);
  EXPECT_NE(saved.error().message.find("--state"), std::string::npos);
}

}  // namespace
}  // namespace seeker::testing
