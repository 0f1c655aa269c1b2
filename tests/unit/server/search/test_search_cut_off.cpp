// A search whose program was cut off goes on with what it had seen and listed.

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/unit/server/search/toy_world.hpp"

namespace seeker::search {
namespace {

TEST(SearchMission, SearchThatWasCutOffGoesOnWithWhatItHadSeenAndListed) {
  constexpr double kUntilCutOff_s = 25.0;
  for (const Strategy strategy : {Strategy::kPlan, Strategy::kPaper}) {
    auto first = mission_of(strategy);
    ToyRobot robot(furnished_rooms(), {1.0, 1.0, 0.3}, true, 13);
    const ToyRun cut_off = robot.run(first, kUntilCutOff_s);
    ASSERT_FALSE(cut_off.end);
    ASSERT_FALSE(cut_off.lists.searched.empty());

    auto second = mission_of(strategy);
    second.take_back(first.evidence().own_looks(cut_off.pose.translation(), 200), cut_off.lists);
    EXPECT_EQ(second.lists().searched, cut_off.lists.searched);
    const Point2 seen = cut_off.lists.searched.front();
    EXPECT_NEAR(second.evidence().probability_at(seen), first.evidence().probability_at(seen), 0.01);
    const ToyRun rest = robot.run(second, 1200.0);
    print("the rest", rest);
    ASSERT_TRUE(rest.end);
    const auto new_cells = std::count_if(rest.events.begin(), rest.events.end(),
                                         [](const SearchEvent& event) { return event.kind == "cell_searched"; });
    EXPECT_EQ(cut_off.lists.searched.size() + static_cast<std::size_t>(new_cells), rest.lists.searched.size())
        << "no cell is searched, or told, twice";
  }
}

TEST(SearchMission, ListsAndLooksOfCellsOfAnotherSizeAreNotTakenBack) {
  auto mission = mission_of(Strategy::kPlan);
  GridLists lists;
  lists.cell_size_m = 0.3;
  lists.searched = {{1.0, 1.0}};
  mission.take_back(Grid<std::uint8_t>({Point2::Zero(), 0.3}, 10, 10, 200), lists);
  EXPECT_TRUE(mission.lists().searched.empty());
  EXPECT_EQ(mission.evidence().probability_at({1.0, 1.0}), 0.0);
}

}  // namespace
}  // namespace seeker::search
