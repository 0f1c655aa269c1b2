#include "server/app/state/kept_files.hpp"

#include <gtest/gtest.h>

#include "common/files/files.hpp"
#include "tests/support/matchers.hpp"
#include "tests/unit/server/store/temporary_folder.hpp"

namespace seeker::app {
namespace {

TopologyMemory topology() {
  TopologyMemory memory;
  for (std::uint64_t id : {2U, 5U}) {
    TopologyNode node;
    node.id = id;
    node.map_T_base = {static_cast<double>(id), 0.5, 0.25};
    node.sectors.push_back({{0.125, 0.0}, 0.5, 1.0, 4.0});
    node.goals.push_back({10 + id, {static_cast<double>(id), 3.0}, 2});
    memory.topology.nodes.push_back(node);
  }
  memory.topology.edges = {{2, 5}};
  memory.topology.current = 5;
  memory.closed_map = {{1.0, 2.0}};
  memory.looked_at_map = {{3.0, 4.0}, {5.0, 6.0}};
  return memory;
}

MissionMemory memory() {
  SearchMemory search;
  search.looks = Grid<std::uint8_t>({Point2(-1.5, 2.0), 0.25}, 3, 2, 0);
  search.looks[{1, 1}] = 200;
  search.lists = {.cell_size_m = 0.75,
                  .searched = {{1.0, 2.0}},
                  .unsearched = {{3.0, 4.0}, {5.0, 6.0}},
                  .unreachable = {{7.0, 8.0}},
                  .passes_n = 2,
                  .passes_limit_n = 9};
  return {topology(), search};
}

TEST(KeptFiles, ComeOutAsTheyWentInForTheSameStateOfTheMap) {
  const testing::TemporaryFolder folder;
  api::Detection bag;
  bag.id = 7;
  bag.target = "bag";
  bag.mission = "round";
  bag.position = Point2(2.0, 3.0);
  const MissionSoFar so_far{Point2(4.0, 5.0), std::chrono::seconds(90), {bag}};
  ASSERT_TRUE(keep_place(folder.path(), "round", {{1.0, 2.0, 3.0}, so_far}));
  ASSERT_TRUE(keep_memory(folder.path(), "round", memory(), 7));
  std::string trouble;
  const KeptState kept = read_kept(folder.path(), "round", 7, trouble);
  ASSERT_TRUE(kept.map_T_base);
  EXPECT_EQ(*kept.map_T_base, (Pose2{1.0, 2.0, 3.0}));
  EXPECT_EQ(kept.memory, memory());
  EXPECT_EQ(kept.so_far, so_far);
  const KeptState moved = read_kept(folder.path(), "round", 8, trouble);
  EXPECT_TRUE(moved.map_T_base) << "where to look is a hint";
  EXPECT_EQ(moved.memory, MissionMemory{}) << "places of a map that has moved";
  EXPECT_TRUE(trouble.empty()) << trouble;
}

TEST(KeptFiles, DamageIsToldAndTheRestIsUsed) {
  const testing::TemporaryFolder folder;
  std::string trouble;
  EXPECT_FALSE(read_kept(folder.path(), "round", 0, trouble).map_T_base);
  EXPECT_TRUE(trouble.empty()) << "nothing was kept: " << trouble;
  ASSERT_TRUE(keep_place(folder.path(), "round", {}));
  ASSERT_TRUE(keep_memory(folder.path(), "round", memory(), 0));
  ASSERT_TRUE(files::write_file(folder.path() / "round.topology", "garbage"));
  const KeptState kept = read_kept(folder.path(), "round", 0, trouble);
  EXPECT_TRUE(kept.map_T_base);
  EXPECT_FALSE(kept.memory.topology);
  EXPECT_EQ(kept.memory.search, memory().search);
  EXPECT_NE(trouble.find("round.topology"), std::string::npos) << trouble;
}

TEST(KeptFiles, AreDroppedTogether) {
  const testing::TemporaryFolder folder;
  ASSERT_TRUE(keep_place(folder.path(), "round", {}));
  ASSERT_TRUE(keep_memory(folder.path(), "round", memory(), 1));
  drop_kept(folder.path());
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace seeker::app
