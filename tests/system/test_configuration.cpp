// Every robot file that ships can be read; mistakes are named with file, line and path.

#include <filesystem>
#include <fstream>

#include "tests/system/simulated_robot.hpp"

namespace seeker::testing {
namespace {

TEST(RobotFiles, EveryShippedOneIsReadAndPrintsBackTheSame) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(source_file("config/robots"))) {
    const Result<app::RobotOptions> options = app::load_robot_options(entry.path());
    ASSERT_TRUE(options) << options.error().message;
    const std::string text = config::print(*options);
    const Result<config::Document> document = config::Document::parse(text, "printed");
    ASSERT_TRUE(document) << document.error().message;
    app::RobotOptions again;
    ASSERT_TRUE(document->read(again)) << entry.path();
    EXPECT_EQ(config::print(again), text) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 3);
}

TEST(RobotFiles, UnknownKeyIsNamedWithPlaceAndChoice) {
  const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "broken_robot.yaml";
  std::ofstream(file) << "robot_id: x\nsim:\n  sped: 1\n";
  const Result<app::RobotOptions> options = app::load_robot_options(file);
  ASSERT_FALSE(options);
  EXPECT_NE(options.error().message.find("broken_robot.yaml:3: sim.sped: unknown key; allowed here: world"),
            std::string::npos)
      << options.error().message;
}

TEST(RobotFiles, MissingLogOfAReplayIsNamed) {
  const Result<app::RobotOptions> options =
      app::load_robot_options(source_file("config/robots/replay.yaml"), {"replay.log=no-such-file.clf"});
  ASSERT_TRUE(options) << options.error().message;
  const Result<app::Assembly> assembly = app::assemble(*options);
  ASSERT_FALSE(assembly);
  EXPECT_NE(assembly.error().message.find("no-such-file.clf"), std::string::npos);
}

}  // namespace
}  // namespace seeker::testing
