// Every robot file that ships can be read; mistakes are named with file, line and path.

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>

#include "tests/system/simulated_robot.hpp"

namespace seeker::testing {
namespace {

TEST(RobotFiles, EveryShippedOneIsReadAndPrintsBackTheSame) {
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(source_file("config/robots"))) {
    if (entry.is_directory()) {
      continue;  // config/robots/paper
    }
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

/// Files of a temporary folder, by name and text; loads the first of them.
Result<app::RobotOptions> load_first(const std::vector<std::pair<std::string, std::string>>& files,
                                     const std::vector<std::string>& overrides = {}) {
  // Tests run at the same time.
  const std::string test = ::testing::UnitTest::GetInstance()->current_test_info()->name();
  const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / ("robots-" + test);
  std::filesystem::remove_all(folder);
  for (const auto& [name, text] : files) {
    std::filesystem::create_directories((folder / name).parent_path());
    std::ofstream(folder / name) << text;
  }
  return app::load_robot_options(folder / files.front().first, overrides);
}

TEST(RobotFiles, BaseSaysWhatAFileLeavesOut) {
  const Result<app::RobotOptions> options =
      load_first({{"mine.yaml", "base: shared/team.yaml\nrobot_id: mine\nsim: {speed: 2}\n"},
                  {"shared/team.yaml", "base: ../all.yaml\nrobot_id: team\nsim: {seed: 7, speed: 1}\n"},
                  {"all.yaml", "robot_id: all\nrobot_radius_m: 0.31\n"}},
                 {"sim.seed=9"});
  ASSERT_TRUE(options) << options.error().message;
  EXPECT_EQ(options->robot_id, "mine");
  EXPECT_EQ(options->sim.speed, 2.0);
  EXPECT_EQ(options->sim.seed, 9U) << "the command line has the last word";
  EXPECT_EQ(options->robot_radius_m, 0.31);
  EXPECT_EQ(options->base, "") << "what is printed stands for itself";
  EXPECT_EQ(options->folders.size(), 3U);
}

TEST(RobotFiles, PathOfABaseIsFoundFromItsOwnFolder) {
  const Result<app::RobotOptions> options = load_first({{"mine/robot.yaml", "base: ../team/robot.yaml\n"},
                                                        {"team/robot.yaml", "sim: {world: home.yaml}\n"},
                                                        {"team/home.yaml", ""}});
  ASSERT_TRUE(options) << options.error().message;
  EXPECT_EQ(app::resolve(*options, options->sim.world).parent_path().filename(), "team");
}

TEST(RobotFiles, MistakesOfABaseAreNamedWhereTheyStand) {
  const auto message = [](const std::vector<std::pair<std::string, std::string>>& files) {
    const Result<app::RobotOptions> options = load_first(files);
    return options ? "read" : options.error().message;
  };
  EXPECT_THAT(message({{"mine.yaml", "base: team.yaml\n"}, {"team.yaml", "robot_id: a\nsped: 1\n"}}),
              ::testing::HasSubstr("team.yaml:2: sped: unknown key"));
  EXPECT_THAT(message({{"mine.yaml", "base: team.yaml\nsped: 1\n"}, {"team.yaml", "robot_id: a\n"}}),
              ::testing::HasSubstr("mine.yaml:2: sped: unknown key"));
  EXPECT_THAT(
      message({{"mine.yaml", "base: nobody.yaml\n"}}),
      ::testing::AllOf(::testing::HasSubstr("mine.yaml: base: "), ::testing::HasSubstr("nobody.yaml: no such")));
  EXPECT_THAT(message({{"mine.yaml", "base: mine.yaml\n"}}), ::testing::HasSubstr("does one of them name itself"));
  const Result<app::RobotOptions> text = app::parse_robot_options("base: sim.yaml\n", "robot.yaml");
  ASSERT_FALSE(text);
  EXPECT_THAT(text.error().message, ::testing::HasSubstr("base: a text that is no file"));
}

TEST(RobotFiles, ALargerRobotPlansAsOneUnlessItsFileSaysOtherwise) {
  const Result<app::RobotOptions> usual = load_first({{"robot.yaml", "robot_id: a\n"}});
  const Result<app::RobotOptions> larger =
      load_first({{"robot.yaml", "base: all.yaml\nrobot_radius_m: 0.36\nexplore: {cost: {robot_radius_m: 0.4}}\n"},
                  {"all.yaml", "robot_radius_m: 0.3\n"}});
  ASSERT_TRUE(usual && larger);
  const double by_m = 0.36 - usual->robot_radius_m;
  EXPECT_NEAR(larger->go.cost_map.robot_radius_m, usual->go.cost_map.robot_radius_m + by_m, 1e-9);
  EXPECT_NEAR(larger->loop.safety.clearance.radius_m, usual->loop.safety.clearance.radius_m + by_m, 1e-9);
  EXPECT_NEAR(larger->explore.driver.follower.clearance.radius_m,
              usual->explore.driver.follower.clearance.radius_m + by_m, 1e-9);
  EXPECT_NEAR(larger->sim.robot.radius_m, usual->sim.robot.radius_m + by_m, 1e-9);
  EXPECT_EQ(larger->explore.cost.robot_radius_m, 0.4);
}

TEST(RobotFiles, ThePapersStereoModeIsAllOfItBeforeTheFilesOwnValues) {
  const Result<app::RobotOptions> paper = app::load_robot_options(source_file("config/robots/paper/stereo-2017.yaml"));
  ASSERT_TRUE(paper) << paper.error().message;
  const app::StereoSettings& stereo = paper->stereo;
  EXPECT_EQ(stereo.features.match, vision::paper_stereo_params().match);
  EXPECT_EQ(stereo.database, localize::paper_database_params());
  EXPECT_EQ(stereo.estimator.update, localize::paper_update_params());
  EXPECT_EQ(stereo.localiser.mode, localize::FilterMode::kPaper);
  EXPECT_EQ(stereo.localiser.eye_height_m, 0.9) << "where the camera is mounted is no method";
  const Result<app::RobotOptions> mixed =
      load_first({{"mine.yaml", "base: paper.yaml\nstereo: {features: {match: {max_disparity_px: 100}}}\n"},
                  {"paper.yaml", "stereo: {mode: paper, database: {salient_seen: 2}}\n"}});
  ASSERT_TRUE(mixed) << mixed.error().message;
  EXPECT_EQ(mixed->stereo.features.match.max_disparity_px, 100.0);
  EXPECT_EQ(mixed->stereo.database.salient_seen, 2);
  EXPECT_EQ(mixed->stereo.database.association.bbf_leaves, 200);
}

TEST(RobotFiles, ARobotOfNoSizeIsRefused) {
  for (const char* radius : {"0", "-0.2", "50"}) {
    const Result<app::RobotOptions> options =
        load_first({{"robot.yaml", "robot_id: a\nrobot_radius_m: " + std::string(radius) + "\n"}});
    ASSERT_FALSE(options) << radius;
    EXPECT_THAT(options.error().message, ::testing::HasSubstr("robot.yaml:2: robot_radius_m: must be above 0"));
  }
}

TEST(RobotFiles, MissingLogOfAReplayIsNamed) {
  const Result<app::RobotOptions> options =
      app::load_robot_options(source_file("config/robots/replay.yaml"), {"replay.log=no-such-file.clf"});
  ASSERT_TRUE(options) << options.error().message;
  const Result<app::Assembly> assembly = app::assemble(*options);
  ASSERT_FALSE(assembly);
  EXPECT_NE(assembly.error().message.find("no-such-file.clf"), std::string::npos);
}

TEST(RobotFiles, WhatARobotIsNotFittedWithIsNoDeviceOfIt) {
  const auto assembled = [](const std::vector<std::string>& overrides) {
    return app::assemble(app::load_robot_options(source_file("config/robots/sim.yaml"), overrides).value());
  };
  const Result<app::Assembly> usual = assembled({});
  ASSERT_TRUE(usual);
  EXPECT_TRUE(usual->parts.devices.lidar && usual->parts.devices.sonar && usual->parts.devices.camera &&
              usual->parts.devices.stereo);
  const Result<app::Assembly> blind =
      assembled({"estimator=odometry", "sensors.lidar=false", "sensors.camera=false", "sensors.stereo=false"});
  ASSERT_TRUE(blind) << blind.error().message;
  EXPECT_FALSE(blind->parts.devices.lidar || blind->parts.devices.camera || blind->parts.devices.stereo);
  EXPECT_TRUE(blind->parts.devices.sonar && blind->parts.devices.base);
}

TEST(RobotFiles, AnEstimatorThatNeedsALidarIsRefusedWithoutOne) {
  for (const std::string estimator : {"line_slam", "scan_match"}) {
    const Result<app::Assembly> assembly =
        app::assemble(app::load_robot_options(source_file("config/robots/sim.yaml"),
                                              {"sensors.lidar=false", "estimator=" + estimator})
                          .value());
    ASSERT_FALSE(assembly) << estimator;
    EXPECT_THAT(assembly.error().message,
                ::testing::AllOf(::testing::HasSubstr(estimator), ::testing::HasSubstr("estimator: odometry")));
  }
}

TEST(RobotFiles, PeopleWalkWhereTheWorldOrTheRobotSaysSo) {
  std::ifstream office(source_file("config/worlds/office.yaml"));
  std::string text((std::istreambuf_iterator<char>(office)), std::istreambuf_iterator<char>());
  const auto put = [&text](const std::string& what, const std::string& instead) {
    const std::size_t at = text.find(what);
    ASSERT_NE(at, std::string::npos) << what;
    text.replace(at, what.size(), instead);
  };
  put("people_walk: false", "people_walk: true");
  put("../targets/", source_file("config/targets/").string());
  const std::filesystem::path busy = std::filesystem::path(::testing::TempDir()) / "busy_office.yaml";
  std::ofstream(busy) << text;
  const std::string quiet = source_file("config/worlds/office.yaml");
  const auto people_walk = [](const std::string& world, const std::string& people) {
    const Result<app::RobotOptions> options =
        app::load_robot_options(source_file("config/robots/sim.yaml"), {"sim.world=" + world, "sim.people=" + people});
    const Result<app::Assembly> assembly = app::assemble(options.value());
    EXPECT_TRUE(assembly) << assembly.error().message;
    return assembly && assembly->simulation->world().people_walk;
  };
  EXPECT_TRUE(people_walk(busy.string(), "false"));
  EXPECT_TRUE(people_walk(quiet, "true"));
  EXPECT_FALSE(people_walk(quiet, "false"));
}

TEST(RobotFiles, ARobotIdThatNamesNoFolderIsRefusedWhereItStands) {
  const auto options = app::load_robot_options(source_file("config/robots/sim.yaml"), {"robot_id=../../esc"});
  ASSERT_FALSE(options);
  EXPECT_NE(options.error().message.find("robot_id"), std::string::npos) << options.error().message;
  EXPECT_NE(options.error().message.find("64 letters"), std::string::npos) << options.error().message;
  const auto written = app::parse_robot_options("driver: sim\nrobot_id: a/b\n", "robot.yaml", {});
  ASSERT_FALSE(written);
  EXPECT_NE(written.error().message.find("robot.yaml:2"), std::string::npos) << written.error().message;
}

}  // namespace
}  // namespace seeker::testing
