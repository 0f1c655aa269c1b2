#include <thread>

#include "tests/unit/client/cli/verbs_fixture.hpp"

namespace seeker::cli {
namespace {

namespace fs = std::filesystem;

class TopologyVerbs : public VerbsFixture {
 protected:
  static RobotTopology two_nodes() {
    RobotTopology robot;
    robot.robot_id = "r1";
    TopologyNode first;
    first.id = 1;
    TopologyNode second;
    second.id = 2;
    second.map_T_base = {3.0, 0.0, 0.0};
    second.sectors = {{{0.2, 0.0}, -1.0, 2.0, 1.0}, {{0.2, 0.0}, -0.5, 1.0, 2.0}};
    second.goals = {{7, {6.0, 0.5}, 2}};
    robot.topology = {{first, second}, {{1, 2}}, 2};
    robot.target_map = Point2(6.0, 0.5);
    return robot;
  }
  /// Runs a verb while the robot reports a topology again and again.
  Ran run_with(const RobotTopology& robot, const std::vector<std::string>& arguments) {
    return run(arguments, [&] {
      for (int n = 0; n < 20; ++n) {
        host->publish(api::Topic::kTopology, robot_time_s(n), robot);
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      }
    });
  }
};

TEST_F(TopologyVerbs, ListNodesAndGoalsAndDrawThemWithTheSpaceTree) {
  const Ran ran = run_with(two_nodes(), {"topology", "--picture", path("out/topology.svg")});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(ran.out.rfind("2 nodes, 1 edge, 1 goal, drives to (6.00, 0.50) m\n", 0), 0U) << ran.out;
  EXPECT_NE(ran.out.find("2 at (3.00, 0.00) m, 1 goal, here"), std::string::npos) << ran.out;
  EXPECT_TRUE(fs::exists(path("out/topology.svg")));
}

TEST_F(TopologyVerbs, GiveAllOfItAsJson) {
  const Ran ran = run_with(two_nodes(), {"topology", "--json"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_NE(ran.out.find(R"("edges":[[1,2]])"), std::string::npos) << ran.out;
  EXPECT_NE(ran.out.find(R"("goals":[{"id":7,"x_m":6.0,"y_m":0.5,"layer":2}])"), std::string::npos) << ran.out;
  EXPECT_NE(ran.out.find(R"("target":{"x_m":6.0,"y_m":0.5})"), std::string::npos) << ran.out;
}

TEST_F(TopologyVerbs, SayHowToBeginWhereThereIsNone) {
  RobotTopology none;
  none.robot_id = "r1";
  const Ran ran = run_with(none, {"topology"});
  EXPECT_EQ(ran.code, 0);
  EXPECT_NE(ran.err.find("explore --strategy topological"), std::string::npos) << ran.err;
}

TEST_F(TopologyVerbs, SayWhyNothingComes) {
  const Ran ran = run({"topology", "--timeout", "0.2"});
  EXPECT_NE(ran.code, 0);
  EXPECT_NE(ran.err.find("sends no topology"), std::string::npos) << ran.err;
}

}  // namespace
}  // namespace seeker::cli
