#include "server/app/fleet/fleet_memory.hpp"

#include <fstream>

#include "common/files/files.hpp"
#include "tests/unit/server/app/fleet/fleet_fixture.hpp"
#include "tests/unit/server/store/temporary_folder.hpp"

namespace seeker::testing {
namespace {

namespace fs = std::filesystem;

/// A memory in a folder; what it reports as damaged.
struct MemoryParts {
  explicit MemoryParts(const fs::path& folder)
      : pieces(folder), memory(folder, "main", pieces, [this](const std::string& what) { damage.push_back(what); }) {}
  std::vector<std::string> damage;
  app::PieceFiles pieces;
  app::FleetMemory memory;
};

const fleet::NodePictures kNoPictures;

std::size_t pieces_in(const fs::path& folder) {
  std::size_t count = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    count += entry.path().extension() == ".piece" ? 1 : 0;
  }
  return count;
}

app::RobotReport own_report() {
  app::RobotReport report;
  report.topology = at_place("main", {2.0, 1.0});
  report.finds.now = {found_at(1, {1.0, 1.0})};
  return report;
}

void keep_all(MemoryParts& parts, const LineMap& own) {
  const fleet::NodePictures pictures = pictures_of({picture_of(own.nodes.front().id)});
  const fleet::MergeAnswer answer = answer_with(fleet::MergeVerdict::kMerged, {1.0, 2.0, 0.0});
  parts.memory.keep({&own, &pictures, 1, 5, {{0, 2, answer}, {1, 2, answer}}}, own_report(), {{"r1", 1}, {"r2", 2}});
}

TEST(FleetMemory, ComesOutAsItWentIn) {
  const TemporaryFolder folder;
  const LineMap own = small_map();
  MemoryParts parts(folder.path());
  keep_all(parts, own);
  MemoryParts again(folder.path());
  const auto kept = again.memory.read();
  ASSERT_TRUE(kept);
  EXPECT_EQ(app::FleetMemory::slots_of(*kept).kept(), (std::map<std::string, std::uint8_t>{{"r1", 1}, {"r2", 2}}));
  const app::RememberedFleet fleet = again.memory.recall(*kept);
  EXPECT_EQ(fleet.joint_epoch, 5U);
  ASSERT_TRUE(fleet.own_map);
  EXPECT_EQ(fleet.own_map->nodes, own.nodes);
  EXPECT_EQ(fleet.own_map->keyframes, own.keyframes);
  ASSERT_EQ(fleet.own_pictures.size(), 1U);
  EXPECT_EQ(*fleet.own_pictures.front(), picture_of(own.nodes.front().id));
  EXPECT_TRUE(fleet.own_topology);
  EXPECT_EQ(fleet.own_finds.size(), 1U);
  ASSERT_EQ(fleet.pairs.size(), 2U);
  EXPECT_EQ(fleet.pairs[1].slot_a, 1);
  EXPECT_EQ(fleet.pairs[1].slot_b, 2);
  EXPECT_EQ(fleet.pairs[1].answer.hypotheses.front().a_T_b.a_T_b, (Pose2{1.0, 2.0, 0.0}));
  EXPECT_TRUE(again.damage.empty());
}

TEST(FleetMemory, IsWrittenOnlyWhereThereIsAnOwnMapThatHasChanged) {
  const TemporaryFolder folder;
  MemoryParts parts(folder.path());
  const LineMap none;
  parts.memory.keep({&none, &kNoPictures, 0, 0, {}}, {}, {});
  EXPECT_FALSE(parts.memory.read());
  const LineMap own = small_map();
  keep_all(parts, own);
  ASSERT_TRUE(fs::remove(folder.path() / "memory"));
  keep_all(parts, own);
  EXPECT_FALSE(fs::exists(folder.path() / "memory")) << "it says the same";
}

TEST(FleetMemory, KeepsOnlyThePiecesOfTheNewestOwnMap) {
  const TemporaryFolder folder;
  MemoryParts parts(folder.path());
  const LineMap longer = small_map(3);
  parts.memory.keep({&longer, &kNoPictures, 1, 0, {}}, {}, {});
  EXPECT_EQ(pieces_in(folder.path() / "main"), 3U);
  const LineMap other = small_map(2, 9);
  parts.memory.keep({&other, &kNoPictures, 2, 0, {}}, {}, {});
  EXPECT_EQ(pieces_in(folder.path() / "main"), 2U);
}

TEST(FleetMemory, WritesNoPieceOfTheMapThatItHasRecalled) {
  const TemporaryFolder folder;
  MemoryParts parts(folder.path());
  keep_all(parts, small_map());
  MemoryParts again(folder.path());
  const app::RememberedFleet fleet = again.memory.recall(*again.memory.read());
  again.memory.set_own_version(4);
  fs::remove_all(folder.path() / "main");
  again.memory.keep({&*fleet.own_map, &fleet.own_pictures, 4, 6, {}}, {}, {});
  EXPECT_FALSE(fs::exists(folder.path() / "main"));
  EXPECT_EQ(again.memory.read()->joint_epoch(), 6U);
}

TEST(FleetMemory, ReportsDamageAndKeepsTheEpoch) {
  const TemporaryFolder folder;
  MemoryParts parts(folder.path());
  keep_all(parts, small_map());
  MemoryParts again(folder.path());
  const auto kept = again.memory.read();
  ASSERT_TRUE(kept);
  fs::remove_all(folder.path() / "main");
  const app::RememberedFleet fleet = again.memory.recall(*kept);
  EXPECT_FALSE(fleet.own_map);
  EXPECT_TRUE(fleet.pairs.empty());
  EXPECT_EQ(fleet.joint_epoch, 5U);
  EXPECT_EQ(again.damage.size(), 1U);
  ASSERT_TRUE(files::write_file(folder.path() / "memory", "garbage"));
  EXPECT_FALSE(again.memory.read());
  EXPECT_EQ(again.damage.size(), 2U);
}

TEST(FleetMemory, LeavesOutAPairThatIsDamaged) {
  const TemporaryFolder folder;
  MemoryParts parts(folder.path());
  keep_all(parts, small_map());
  MemoryParts again(folder.path());
  auto kept = again.memory.read();
  ASSERT_TRUE(kept);
  kept->mutable_pairs(0)->set_verdict(9);
  const app::RememberedFleet fleet = again.memory.recall(*kept);
  EXPECT_EQ(fleet.pairs.size(), 1U);
  EXPECT_EQ(again.damage.size(), 1U);
}

TEST(PieceFiles, GiveBackOnlyWhatHasTheHashOfItsName) {
  const TemporaryFolder folder;
  const app::PieceFiles files(folder.path());
  const app::PackedMap robot = packed(small_map());
  EXPECT_TRUE(files.load(robot.manifest).empty());
  for (const auto& [hash, bytes] : robot.pieces) {
    files.keep("r1", hash, bytes);
  }
  EXPECT_EQ(files.load(robot.manifest).size(), 2U);
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.path() / "r1")) {
    std::ofstream(entry.path(), std::ios::app) << "more";
    break;
  }
  EXPECT_EQ(files.load(robot.manifest).size(), 1U);
  files.drop_all_but("r1", {*robot.pieces.begin()});
  EXPECT_EQ(pieces_in(folder.path() / "r1"), 1U);
}

}  // namespace
}  // namespace seeker::testing
