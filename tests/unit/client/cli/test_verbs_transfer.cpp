#include <filesystem>
#include <fstream>
#include <sstream>

#include <unistd.h>

#include <gtest/gtest.h>

#include "common/digest/sha256.hpp"
#include "common/image/png.hpp"
#include "tests/unit/client/cli/cli_fixture.hpp"

namespace seeker::cli {
namespace {

namespace fs = std::filesystem;

class TransferVerbs : public ::testing::Test, public CliFixture {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) / ("seeker_cli_transfer_" + std::to_string(::getpid()) + "_" +
                                                ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string read(const std::string& name) const {
    std::ifstream file(folder_ / name, std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  }
  std::size_t files() const { return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), {})); }
  static std::vector<std::uint8_t> long_bytes(std::uint8_t first) {
    std::vector<std::uint8_t> bytes(700'000);
    for (std::size_t k = 0; k < bytes.size(); ++k) {
      bytes[k] = static_cast<std::uint8_t>(first + k % 251);
    }
    return bytes;
  }
  std::string part_name(const std::string& file, const std::vector<std::uint8_t>& bytes) const {
    return path(file) + "." + digest::to_hex(digest::sha256_of(bytes)).substr(0, 16) + ".part";
  }

  fs::path folder_;
};

TEST_F(TransferVerbs, LandmarksAreSentAndFetched) {
  const std::vector<std::uint8_t> bytes = long_bytes(1);
  std::ofstream(path("lab.seekerlm"), std::ios::binary).write(reinterpret_cast<const char*>(bytes.data()), 700'000);
  const Ran sent = run({"landmarks", "upload", path("lab.seekerlm"), "--json"});
  EXPECT_EQ(sent.code, 0) << sent.err;
  EXPECT_NE(sent.out.find("\"name\":\"lab\""), std::string::npos) << sent.out;
  EXPECT_EQ(host->values().landmark_files["lab"], bytes);
  const Ran fetched = run({"landmarks", "download", "lab", path("copy.seekerlm"), "--json"});
  EXPECT_EQ(fetched.code, 0) << fetched.err;
  EXPECT_NE(fetched.out.find("\"ok\":true"), std::string::npos) << fetched.out;
  EXPECT_EQ(read("copy.seekerlm"), read("lab.seekerlm"));
  EXPECT_EQ(files(), 2U) << "nothing is left beside them";
  EXPECT_TRUE(fetched.err.empty()) << "progress is for a terminal only: " << fetched.err;
}

TEST_F(TransferVerbs, ErrorsHaveTheirExitCodes) {
  std::ofstream(path("empty.seekerlm")).flush();
  std::ofstream(path("lab.seekerlm")) << "bytes";
  EXPECT_EQ(run({"landmarks", "upload", path("absent.seekerlm")}).code, 2);
  EXPECT_EQ(run({"landmarks", "upload", path("empty.seekerlm")}).code, 2);
  EXPECT_EQ(run({"landmarks", "upload", path("lab.seekerlm"), "--name", "Not A Name"}).code, 2);
  EXPECT_EQ(run({"landmarks", "download", "absent", path("a")}).code, 1);
  EXPECT_FALSE(fs::exists(path("a")));
  host->edit([](testing::FakeRobotValues& v) { v.failure = Error{Errc::kRefused, "there is such a database"}; });
  EXPECT_EQ(run({"landmarks", "upload", path("lab.seekerlm")}).code, 3);
  host->edit([](testing::FakeRobotValues& v) { v.failure = Error{Errc::kLinkLost, "gone"}; });
  const Ran late = run({"landmarks", "upload", path("lab.seekerlm"), "--timeout", "0.2"});
  EXPECT_EQ(late.code, 5);
  EXPECT_NE(late.err.find("the same command goes on"), std::string::npos) << late.err;
}

TEST_F(TransferVerbs, DownloadGoesOnWhereAnEarlierOneEndedUnlessTheFileHasChanged) {
  const std::vector<std::uint8_t> bytes = long_bytes(3);
  host->edit([&](testing::FakeRobotValues& v) { v.map_files["office"] = bytes; });
  std::ofstream(part_name("office.seekermap", bytes), std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), 690'000);
  EXPECT_EQ(run({"map", "download", "office", path("office.seekermap")}).code, 0);
  EXPECT_EQ(read("office.seekermap"), std::string(bytes.begin(), bytes.end()));
  const auto calls = host->values().calls;
  EXPECT_EQ(std::count(calls.begin(), calls.end(), "seeker-test read_file office"), 2)
      << "hash and size, then the rest";
  EXPECT_EQ(files(), 1U);

  const std::vector<std::uint8_t> other = long_bytes(4);
  std::ofstream(part_name("office.seekermap", bytes)) << "old";
  host->edit([&](testing::FakeRobotValues& v) { v.map_files["office"] = other; });
  const Ran again = run({"map", "download", "office", path("office.seekermap")});
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_NE(again.err.find("has changed since an earlier download"), std::string::npos) << again.err;
  EXPECT_EQ(read("office.seekermap"), std::string(other.begin(), other.end()));
  EXPECT_EQ(files(), 1U);

  std::ofstream(part_name("second", other), std::ios::binary) << std::string(690'000, 'x');
  EXPECT_EQ(run({"map", "download", "office", path("second")}).code, 1) << "damaged on the way or on the disk";
  EXPECT_FALSE(fs::exists(path("second")));
  EXPECT_EQ(run({"map", "download", "office", path("second")}).code, 0);
}

TEST_F(TransferVerbs, RobotOfOlderSoftwareGetsMapsInOneMessage) {
  host->edit([](testing::FakeRobotValues& v) {
    v.too_old_for_pieces = true;
    v.map_files["office"] = {1, 2, 3};
  });
  std::ofstream(path("attic.seekermap")) << "bytes";
  EXPECT_EQ(run({"map", "upload", path("attic.seekermap")}).code, 0);
  EXPECT_EQ(host->values().uploads.back().bytes.size(), 5U);
  EXPECT_EQ(run({"map", "download", "office", path("copy.seekermap")}).code, 0);
  EXPECT_EQ(read("copy.seekermap").size(), 3U);
  const Ran landmarks = run({"landmarks", "upload", path("attic.seekermap")});
  EXPECT_EQ(landmarks.code, 3);
  EXPECT_NE(landmarks.err.find("protocol 1.5"), std::string::npos) << landmarks.err;
}

TEST_F(TransferVerbs, LargePicturesOfTargetsGoByTheirHashOnce) {
  Image picture(300, 300, 1);
  for (std::size_t k = 0; k < picture.data().size(); ++k) {
    picture.data()[k] = static_cast<std::uint8_t>(k * k % 255);
  }
  ASSERT_TRUE(image::write_png(path("poster.png"), picture));
  const auto search = [&](const std::string& id) {
    return run({"search", "--target", path("poster.png"), "--detach", "--id", id});
  };
  ASSERT_EQ(search("first").code, 0) << search("first").err;
  const auto target_of = [&] {
    return std::get<api::SearchMission>(host->values().missions.back().task).targets.front();
  };
  ASSERT_TRUE(target_of().picture_hash.has_value());
  EXPECT_TRUE(target_of().picture.empty());
  const std::vector<std::uint8_t> kept = host->values().incoming.at(*target_of().picture_hash).bytes;
  EXPECT_EQ(image::decode_png(kept).value(), picture);
  const std::uint64_t sent = host->values().piece_bytes;
  host->edit([](testing::FakeRobotValues& v) { v.mission.reset(); });
  ASSERT_EQ(search("second").code, 0);
  EXPECT_EQ(host->values().piece_bytes, sent) << "the robot has it already";
  host->edit([](testing::FakeRobotValues& v) {
    v.mission.reset();
    v.too_old_for_pieces = true;
  });
  ASSERT_EQ(search("third").code, 0);
  EXPECT_FALSE(target_of().picture_hash.has_value());
  EXPECT_EQ(target_of().picture, picture);
}

}  // namespace
}  // namespace seeker::cli
