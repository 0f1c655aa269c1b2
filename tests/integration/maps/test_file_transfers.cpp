// Large files to and from a whole robot, which dies meanwhile.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <future>

#include <gtest/gtest.h>

#include "common/digest/sha256.hpp"
#include "common/files/file_pieces.hpp"
#include "common/files/files.hpp"
#include "common/image/png.hpp"
#include "common/log/log.hpp"
#include "common/rpc/file_transfer.hpp"
#include "common/rpc/robot_client.hpp"
#include "common/rpc/wait.hpp"
#include "server/store/landmark_file.hpp"
#include "server/store/map_file.hpp"
#include "tests/support/maps/random_map.hpp"
#include "tests/support/served_robot.hpp"
#include "tests/unit/server/store/landmark_samples.hpp"
#include "tests/unit/server/store/temporary_folder.hpp"

namespace seeker::testing {
namespace {

namespace fs = std::filesystem;
constexpr std::chrono::seconds kAnswerLimit{60};

class FileTransfers : public ::testing::Test {
 protected:
  FileTransfers() {
    run_on(0);
    rpc::ClientParams params;
    params.client_name = "tester";
    params.connect_timeout = params.call_timeout = kAnswerLimit;
    params.reconnect.first_delay = std::chrono::milliseconds(5);
    client_ = rpc::RobotClient::connect({"127.0.0.1", run_->port()}, params).value();
  }
  ~FileTransfers() override { client_->close(); }

  [[nodiscard]] fs::path state() const { return folder_.path() / "state"; }
  /// One run of a robot's program, on a port that the next one takes again.
  void run_on(std::uint16_t port) {
    const app::RobotOptions options = sim_robot_options();
    app::Assembly assembly = app::assemble(options, {state() / "landmarks", "r1", "1.0"}).value();
    run_.emplace(options, std::move(assembly), on_port(port), state() / "maps", state() / "incoming");
  }
  void restart() {
    const std::uint16_t port = run_->port();
    run_.reset();
    run_on(port);
  }
  template <class T, class Call>
  [[nodiscard]] Result<T> ask(Call&& call) {
    return rpc::wait<T>(std::forward<Call>(call), kAnswerLimit);
  }
  /// Sends a file; `before` is called before each piece is read.
  [[nodiscard]] Result<api::UploadedFile> send(
      const fs::path& file, api::UploadEnd end, const std::function<void()>& before = [] {}) {
    const files::FileReader reader = files::FileReader::open(file).value();
    end.hash = digest::sha256_of_file(file).value();
    rpc::FileTransfer transfer(client_, {});
    const Status sent =
        transfer.send({end.kind, end.hash, fs::file_size(file)}, [&](std::uint64_t offset, std::size_t n) {
          before();
          return reader.read(offset, n);
        });
    return sent ? transfer.finish(end) : Result<api::UploadedFile>(tl::unexpected<Error>(sent.error()));
  }
  [[nodiscard]] Status fetch(api::FileKind kind, const std::string& name, const fs::path& to) {
    rpc::FileTransfer transfer(client_, {});
    const auto about = transfer.look(kind, name);
    if (!about) {
      return tl::unexpected<Error>(about.error());
    }
    return transfer.receive({kind, name, 0, 0, std::nullopt}, *about,
                            [&](std::uint64_t offset, std::span<const std::uint8_t> bytes) {
                              return files::write_piece(to, offset, bytes);
                            });
  }

  TemporaryFolder folder_;
  log::ScopedSink quiet_{[](const log::Line&) {}};
  std::optional<ServedRobot> run_;
  std::shared_ptr<rpc::RobotClient> client_;
};

TEST_F(FileTransfers, MapOf40MiBGoesUpOverADeathOfTheRobotAndComesDown) {
  Rng rng(11);
  const fs::path file = folder_.path() / "large.seekermap";
  store::MapFile map;
  map.origin.name = "large";
  map.map = random_map(rng, {.nodes = 40, .segments = 400, .keyframes = 6000, .beams = 31});
  for (MapKeyframe& keyframe : map.map.keyframes) {
    keyframe.ranges.resize(3600);  // random ones, which cannot be compressed
    std::generate(keyframe.ranges.begin(), keyframe.ranges.end(),
                  [&] { return static_cast<std::uint16_t>(rng.bits()); });
  }
  ASSERT_TRUE(store::write_map_file(file, map));
  ASSERT_GT(fs::file_size(file), std::uintmax_t{40} << 20U);
  int pieces = 0;
  const auto taken = send(file, {api::FileKind::kMap, {}, "large", false, false}, [&] {
    if (++pieces == 60) {
      restart();
    }
  });
  ASSERT_TRUE(taken) << taken.error().message;
  EXPECT_EQ(taken->map->keyframes, 6000U);
  const auto all = static_cast<int>(fs::file_size(file) / (256UL << 10U));
  EXPECT_LE(pieces, all + 16) << "it went on where it was";
  const Status fetched = fetch(api::FileKind::kMap, "large", folder_.path() / "back.seekermap");
  ASSERT_TRUE(fetched) << fetched.error().message;
  EXPECT_EQ(digest::sha256_of_file(folder_.path() / "back.seekermap").value(), digest::sha256_of_file(file).value());
  EXPECT_TRUE(send(file, {api::FileKind::kMap, {}, "large", false, false}, [] { ADD_FAILURE() << "it is there"; }))
      << "the same map again";
}

TEST_F(FileTransfers, MapsAreCheckedAndOthersAreNotReplaced) {
  Rng rng(12);
  const auto write = [&](const char* name) {
    store::MapFile map;
    map.origin.name = name;
    map.map = random_map(rng);
    const fs::path file = folder_.path() / name;
    EXPECT_TRUE(store::write_map_file(file, map));
    return file;
  };
  const fs::path first = write("first");
  const fs::path second = write("second");
  EXPECT_TRUE(send(first, {api::FileKind::kMap, {}, "office", false, true}));
  EXPECT_FALSE(fs::exists(state() / "maps" / "office.seekermap")) << "it was only checked";
  EXPECT_TRUE(send(first, {api::FileKind::kMap, {}, "office", false, false}));
  EXPECT_EQ(send(second, {api::FileKind::kMap, {}, "office", false, false}).error().code, Errc::kRefused);
  EXPECT_TRUE(send(second, {api::FileKind::kMap, {}, "office", true, false}));
  ASSERT_TRUE(files::write_file(first, "no map at all"));
  EXPECT_EQ(send(first, {api::FileKind::kMap, {}, "third", false, false}).error().code, Errc::kParse);
  EXPECT_EQ(fetch(api::FileKind::kMap, "third", folder_.path() / "x").error().code, Errc::kNotFound);
  const auto unknown = ask<api::UploadedFile>([&](auto reply) {
    client_->finish_upload({api::FileKind::kMap, {}, "a", false, false}, reply);
  });
  EXPECT_EQ(unknown.error().code, Errc::kNotFound);
}

TEST_F(FileTransfers, DatabasesOfLandmarksGoUpAndComeDown) {
  const fs::path file = folder_.path() / "lab.seekerlm";
  const store::LandmarkOrigin origin{"r9", "1.0", "office", 100, 200};
  ASSERT_TRUE(store::write_landmark_file(file, origin, some_landmarks(5, 300)));
  const api::UploadEnd end{api::FileKind::kLandmarks, {}, "lab", false, false};
  const auto taken = send(file, end);
  ASSERT_TRUE(taken) << taken.error().message;
  EXPECT_EQ(taken->landmarks->landmarks, 300U);
  EXPECT_EQ(taken->landmarks->robot_id, "r9");
  EXPECT_EQ(send(file, end)->landmarks, taken->landmarks) << "the same database again";
  const fs::path back = folder_.path() / "back.seekerlm";
  const Status fetched = fetch(api::FileKind::kLandmarks, "lab", back);
  ASSERT_TRUE(fetched) << fetched.error().message;
  EXPECT_EQ(store::read_landmark_file(back)->content, some_landmarks(5, 300));

  ASSERT_TRUE(store::write_landmark_file(file, origin, some_landmarks(6, 20)));
  EXPECT_EQ(send(file, end).error().code, Errc::kRefused);
  ASSERT_TRUE(files::write_file(file, "no database at all"));
  EXPECT_EQ(send(file, {api::FileKind::kLandmarks, {}, "other", false, false}).error().code, Errc::kCorrupt);
  EXPECT_EQ(ask<std::vector<api::LandmarkSummary>>([&](auto reply) { client_->list_landmarks(reply); })->size(), 1U);
}

/// A picture of a mug, written to `file`.
void write_mug(const fs::path& file) {
  Image picture(64, 64, 1);
  for (std::size_t k = 0; k < picture.data().size(); ++k) {
    picture.data()[k] = static_cast<std::uint8_t>(k * k % 255);
  }
  ASSERT_TRUE(image::write_png(file, picture));
}

/// A search for what that picture shows; the robot has the picture from before.
api::MissionRequest search_by_hash(const fs::path& picture, const api::MissionId& id = "look") {
  api::TargetSpec target;
  target.name = "mug";
  target.picture_hash = digest::sha256_of_file(picture).value();
  api::MissionRequest mission;
  mission.id = id;
  mission.task = api::SearchMission{.targets = {target}, .bound = std::nullopt, .keep_out = {}};
  return mission;
}

TEST_F(FileTransfers, MissionNamesAPictureThatWasSentBefore) {
  const fs::path file = folder_.path() / "mug.png";
  write_mug(file);
  const api::MissionRequest mission = search_by_hash(file);
  const auto start = [&] {
    return ask<api::MissionAccepted>([&](auto reply) { client_->start_mission(mission, reply); });
  };
  const auto early = start();
  ASSERT_FALSE(early);
  EXPECT_EQ(early.error().code, Errc::kNotFound);
  EXPECT_NE(early.error().message.find("'mug'"), std::string::npos) << early.error().message;
  const auto sent = send(file, {api::FileKind::kPicture, {}, "", false, false});
  ASSERT_TRUE(sent) << sent.error().message;
  const auto accepted = start();
  ASSERT_TRUE(accepted) << accepted.error().message;
  EXPECT_EQ(accepted->id, "look");

  ASSERT_TRUE(files::write_file(file, "no picture at all"));
  EXPECT_EQ(send(file, {api::FileKind::kPicture, {}, "", false, false}).error().code, Errc::kCorrupt);
}

TEST_F(FileTransfers, MissionWhosePictureIsStillReadDoesNotBeginAfterAStop) {
  const fs::path file = folder_.path() / "mug.png";
  write_mug(file);
  ASSERT_TRUE(send(file, {api::FileKind::kPicture, {}, "", false, false}));
  constexpr int kTries = 20;
  for (int k = 0; k < kTries; ++k) {
    std::promise<Result<api::MissionAccepted>> accepted;
    client_->start_mission(search_by_hash(file, "look-" + std::to_string(k)),
                           [&](auto answer) { accepted.set_value(std::move(answer)); });
    ASSERT_TRUE(ask<void>([&](auto reply) { client_->stop(reply); }));
    const auto answer = accepted.get_future().get();
    const auto status = ask<api::RobotStatus>([&](auto reply) { client_->get_status(reply); });
    ASSERT_TRUE(status) << status.error().message;
    EXPECT_FALSE(status->mission && !status->mission->end) << "it runs, and both were answered";
    EXPECT_TRUE(answer || answer.error().code == Errc::kCancelled) << answer.error().message;
  }
}

}  // namespace
}  // namespace seeker::testing
