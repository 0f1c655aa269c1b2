#include "server/app/fleet/member_records.hpp"

#include <thread>

#include "common/files/files.hpp"
#include "tests/unit/server/app/fleet/fleet_fixture.hpp"
#include "tests/unit/server/store/temporary_folder.hpp"

namespace seeker::testing {
namespace {

/// Records in a folder; what they report as damaged.
struct RecordParts {
  explicit RecordParts(const std::filesystem::path& folder)
      : pieces(folder), records(folder, pieces, [this](const std::string& what) { damage.push_back(what); }) {}
  std::vector<std::string> damage;
  app::PieceFiles pieces;
  app::MemberRecords records;
};

app::MemberRecord record_with_all(const std::string& robot_id) {
  const app::PackedMap robot = packed(small_map(), robot_id);
  return {robot.manifest,
          robot.pieces,
          true,
          Pose2{1.0, 2.0, 0.5},
          at_place(robot_id, {2.0, 1.0}),
          {{found_at(2, {1.0, 1.0})}, {found_at(1, {1.0, 1.0})}}};
}

void keep_with_pieces(RecordParts& parts, const std::string& robot_id) {
  const app::MemberRecord record = record_with_all(robot_id);
  for (const auto& [hash, bytes] : record.pieces) {
    parts.pieces.keep(robot_id, hash, bytes);
  }
  parts.records.keep(robot_id, [&] { return record; });
}

TEST(MemberRecords, ComeOutAsTheyWentInButForTheMainRobot) {
  const TemporaryFolder folder;
  RecordParts parts(folder.path());
  keep_with_pieces(parts, "r2");
  keep_with_pieces(parts, "r1");
  keep_with_pieces(parts, "main");
  std::filesystem::create_directories(folder.path() / "cut-off");
  const std::vector<app::MemberRecord> records = parts.records.load("main");
  ASSERT_EQ(records.size(), 2U);
  const app::MemberRecord expected = record_with_all("r1");
  EXPECT_EQ(records[0].manifest, expected.manifest);
  EXPECT_EQ(records[0].pieces.size(), 2U);
  EXPECT_TRUE(records[0].split);
  EXPECT_EQ(records[0].accepted, expected.accepted);
  EXPECT_TRUE(records[0].topology);
  EXPECT_EQ(records[0].finds.now, expected.finds.now);
  EXPECT_EQ(records[0].finds.before, expected.finds.before);
  EXPECT_EQ(records[1].manifest.robot_id, "r2");
  EXPECT_TRUE(parts.damage.empty());
}

TEST(MemberRecords, ThatAreDamagedAreReportedAndTheOthersStay) {
  const TemporaryFolder folder;
  RecordParts parts(folder.path());
  keep_with_pieces(parts, "r1");
  keep_with_pieces(parts, "r2");
  ASSERT_TRUE(files::write_file(folder.path() / "r2" / "record", "garbage"));
  EXPECT_EQ(parts.records.load("main").size(), 1U);
  EXPECT_EQ(parts.damage.size(), 1U);
  std::filesystem::rename(folder.path() / "r1", folder.path() / "r3");
  EXPECT_TRUE(parts.records.load("main").empty()) << "the record is that of another robot";
  EXPECT_EQ(parts.damage.size(), 3U);
}

TEST(MemberRecords, DropThePiecesThatTheNewestOneDoesNotName) {
  const TemporaryFolder folder;
  RecordParts parts(folder.path());
  keep_with_pieces(parts, "r1");
  app::MemberRecord shorter = record_with_all("r1");
  shorter.pieces.erase(shorter.pieces.begin());
  parts.records.keep("r1", [&] { return shorter; });
  ASSERT_EQ(parts.records.load("main").size(), 1U);
  EXPECT_EQ(parts.records.load("main").front().pieces.size(), 1U);
}

TEST(MemberRecords, NeverGoBackToAnOlderOne) {
  const TemporaryFolder folder;
  RecordParts parts(folder.path());
  std::uint32_t newest = 0;  // guarded by the records while they read it
  const auto keep_next = [&] {
    for (int k = 0; k < 20; ++k) {
      parts.records.keep("r1", [&] {
        app::MemberRecord record = record_with_all("r1");
        record.manifest.map_epoch = ++newest;
        return record;
      });
    }
  };
  std::thread other(keep_next);
  keep_next();
  other.join();
  ASSERT_EQ(parts.records.load("main").size(), 1U);
  EXPECT_EQ(parts.records.load("main").front().manifest.map_epoch, 40U);
}

}  // namespace
}  // namespace seeker::testing
