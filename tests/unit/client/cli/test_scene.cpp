#include "client/cli/scene.hpp"

#include <gtest/gtest.h>

#include "common/image/canvas.hpp"
#include "tests/unit/client/cli/cli_fixture.hpp"

namespace seeker::cli {
namespace {

class SceneOfMission : public ::testing::Test, public CliFixture {
 protected:
  /// The robot keeps evidence and finds of a search; `kind` is the newest mission.
  image::MapScene scene_after(const std::string& kind, SceneOf of) {
    host->edit([&](testing::FakeRobotValues& v) {
      api::MissionStatus mission;
      mission.kind = kind;
      mission.id = kind + "-20261126-074125-abcd";
      mission.state = api::MissionState::kEnded;
      mission.end = api::MissionEnd{api::Outcome::kComplete, "the cause", "", {}};
      v.mission = mission;
      v.grid.lists.searched = {{1, 1}};
      v.grid.evidence.probability = Grid<std::uint8_t>({Point2(0, 0), 0.5}, 4, 4, 0);
      v.grid.evidence.gaps = {{Point2(1, 1), 0.3, "not seen"}};
      v.detections.front().mission = "search-of-yesterday";
    });
    Context context;
    context.robot = host->open({"seeker-test", api::Role::kOperator});
    const auto scene = fetch_scene(context, of);
    EXPECT_TRUE(scene);
    return scene ? *scene : image::MapScene();
  }
};

TEST_F(SceneOfMission, AnExplorationShowsNothingOfTheSearchBefore) {
  const image::MapScene scene = scene_after("explore", SceneOf::kMission);
  EXPECT_EQ(scene.title, "Exploration");
  EXPECT_FALSE(scene.evidence);
  EXPECT_TRUE(scene.gaps.empty());
  EXPECT_TRUE(scene.searched.empty());
  EXPECT_TRUE(scene.detections.empty());
  EXPECT_TRUE(scene.occupancy);
  EXPECT_FALSE(scene.trajectory.empty());
  ASSERT_FALSE(scene.facts.empty());
  EXPECT_EQ(scene.facts.front(), (std::pair<std::string, std::string>("mission", "20261126-074125-abcd")));
  for (const auto& [name, value] : scene.facts) {
    EXPECT_NE(name, "searched") << value;
  }
}

TEST_F(SceneOfMission, ASearchKeepsItsEvidenceAlsoWhenItExplores) {
  const image::MapScene scene = scene_after("search", SceneOf::kMission);
  EXPECT_EQ(scene.title, "Search");
  EXPECT_TRUE(scene.evidence);
  EXPECT_EQ(scene.gaps.size(), 1U);
}

TEST_F(SceneOfMission, AMapAfterADriveIsNotCaptionedAsTheDrive) {
  const image::MapScene scene = scene_after("goto", SceneOf::kMission);
  EXPECT_EQ(scene.title, "Map");
  EXPECT_TRUE(scene.evidence);
  EXPECT_EQ(scene.detections.size(), 1U);
}

TEST_F(SceneOfMission, EvidenceThatIsAskedForIsShownUnderItsOwnTitle) {
  const image::MapScene scene = scene_after("explore", SceneOf::kEvidence);
  EXPECT_EQ(scene.title, "Evidence of a search");
  constexpr double kPanel_px = 294.0;
  EXPECT_LT(image::text_width_px(scene.title, 13.0), kPanel_px);
  EXPECT_TRUE(scene.evidence);
  EXPECT_EQ(scene.detections.size(), 1U);
}

}  // namespace
}  // namespace seeker::cli
