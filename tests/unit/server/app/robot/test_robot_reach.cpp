// What a robot can be asked to do: a base that refuses, restarts or is a recording, a world that is lost.

#include <algorithm>
#include <future>
#include <mutex>

#include <gtest/gtest.h>

#include "common/log/log.hpp"
#include "server/app/composition/robot_assembly.hpp"
#include "server/app/robot/robot.hpp"
#include "tests/support/data.hpp"

namespace seeker::app {
namespace {

using testing::source_file;

/// Drives straight on for ever.
class StraightOn final : public Behaviour {
 public:
  Decision step(const Situation& /*situation*/) override {
    Decision decision;
    decision.command = {0.2, 0.0};
    return decision;
  }
};

/// A base that can be told to refuse what it is asked for.
class MoodyBase final : public drivers::BaseDriver {
 public:
  explicit MoodyBase(std::shared_ptr<drivers::BaseDriver> real) : real_(std::move(real)) {}
  Status activate() override { return real_->activate(); }
  void deactivate() override { real_->deactivate(); }
  Result<std::optional<drivers::OdometrySample>> read() override { return real_->read(); }
  Status set_velocity(const Twist2& velocity, RobotTime now) override {
    return refuses && velocity != Twist2{} ? Status(fail(Errc::kRefused, "not today"))
                                           : real_->set_velocity(velocity, now);
  }
  Status set_motors(bool enabled) override { return real_->set_motors(enabled); }
  Status drivable() const override { return recording ? fail(Errc::kRefused, "it is a recording") : Status(); }

  bool refuses = false;
  bool recording = false;

 private:
  std::shared_ptr<drivers::BaseDriver> real_;
};

/// The clock of a world behind a link.
class LinkedClock final : public drivers::Clock {
 public:
  explicit LinkedClock(std::shared_ptr<drivers::Clock> real) : real_(std::move(real)) {}
  RobotTime now() const override { return real_->now(); }
  Status advance(Duration period) override { return real_->advance(period); }
  Result<bool> await(Duration /*limit*/) override {
    return link || link.error().code != Errc::kCancelled ? Result<bool>(link.has_value())
                                                         : tl::unexpected<Error>(link.error());
  }
  Status reachable() const override { return link; }
  bool lockstep() const override { return real_->lockstep(); }
  double speed() const override { return real_->speed(); }

  Status link;

 private:
  std::shared_ptr<drivers::Clock> real_;
};

class RobotReach : public ::testing::Test {
 protected:
  RobotReach() {
    const RobotOptions options = load_robot_options(source_file("config/robots/sim.yaml")).value();
    LoopParts parts = assemble(options).value().parts;
    base = std::make_shared<MoodyBase>(parts.devices.base);
    clock = std::make_shared<LinkedClock>(parts.devices.clock);
    parts.devices.base = base;
    parts.devices.clock = clock;
    parts.behaviours = [](const api::MissionTask&, const Situation&) {
      return Result<std::unique_ptr<Behaviour>>(std::make_unique<StraightOn>());
    };
    loop = std::make_unique<RobotLoop>(options.loop, std::move(parts), hub);
    loop->hooks().on_event = [this](const api::Event& event) { events.push_back(event); };
    loop->start();
  }

  [[nodiscard]] Result<api::MissionId> go(const std::string& id) {
    return start(id, api::GotoMission{.waypoints = {Point2(1, 0)}, .final_heading_rad = std::nullopt, .keep_out = {}});
  }
  [[nodiscard]] Result<api::MissionId> start(const std::string& id, const api::MissionTask& task) {
    api::MissionRequest request;
    request.id = id;
    request.task = task;
    return loop->commands().start_mission(request, "tester");
  }
  void ticks(int count) {
    for (int k = 0; k < count; ++k) {
      wall += std::chrono::milliseconds(100);
      loop->tick(wall);
    }
  }
  bool await(Duration passed = std::chrono::milliseconds(10)) {
    wall += passed;
    return loop->await({}, wall);
  }
  [[nodiscard]] double way_m() const { return loop->status().odom_T_base.x_m; }
  [[nodiscard]] api::ComponentInfo component(const std::string& name) const {
    for (const api::ComponentInfo& info : loop->diagnostics().components().list(loop->now())) {
      if (info.name == name) {
        return info;
      }
    }
    return {};
  }
  [[nodiscard]] bool told(const std::string& text) const {
    return std::any_of(events.begin(), events.end(),
                       [&](const api::Event& event) { return event.text.find(text) != std::string::npos; });
  }

  std::shared_ptr<MoodyBase> base;
  std::shared_ptr<LinkedClock> clock;
  UpdateHub hub;
  std::unique_ptr<RobotLoop> loop;
  std::vector<api::Event> events;
  WallTime wall;
};

TEST_F(RobotReach, ABaseThatWasRestartedBetweenMissionsDrivesInTheNextOne) {
  ASSERT_TRUE(go("first"));
  ticks(30);
  const double before_m = way_m();
  ASSERT_GT(before_m, 0.2);
  loop->commands().stop();
  ASSERT_TRUE(loop->commands().restart_component("base"));
  ASSERT_TRUE(go("second"));
  ticks(30);
  EXPECT_GT(way_m(), before_m + 0.2) << "its way is counted on";
  EXPECT_TRUE(loop->status().faults.empty()) << loop->status().faults.front().message;
  EXPECT_FALSE(told("odometry-refused"));
}

TEST_F(RobotReach, ARefusedVelocityIsAFaultAndTheEndOfTheMission) {
  base->refuses = true;
  ASSERT_TRUE(go("first"));
  ticks(2);
  ASSERT_EQ(loop->status().faults.size(), 1U);
  EXPECT_EQ(loop->status().faults.front().id, "base-refused");
  ticks(110);
  const api::MissionStatus mission = loop->status().mission.value();
  ASSERT_TRUE(mission.end);
  EXPECT_EQ(mission.end->outcome, api::Outcome::kFault);
  EXPECT_NE(mission.end->cause.find("not today"), std::string::npos) << mission.end->cause;
}

TEST_F(RobotReach, ARecordingIsNotCommanded) {
  base->recording = true;
  const auto refused = go("first");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "it is a recording");
  EXPECT_EQ(start("second", api::ExploreMission{}).error().code, Errc::kRefused);
  EXPECT_EQ(loop->commands().drive("tester", {}).error().message, "it is a recording");
  ASSERT_TRUE(loop->commands().command_lease({"tester"}, {api::LeaseAction::kAcquire, false}, {}));
  EXPECT_FALSE(loop->status().motors_armed);
  const std::vector<std::string> can = loop->capabilities();
  EXPECT_EQ(std::count(can.begin(), can.end(), "goto"), 0);
  EXPECT_EQ(std::count(can.begin(), can.end(), "lidar"), 1);
  api::RecogniseMission recognise;
  recognise.targets.emplace_back();
  recognise.targets.back().name = "ball";
  recognise.targets.back().recogniser = api::RecogniserKind::kSolid;
  EXPECT_TRUE(start("third", recognise)) << "it only looks";
  ticks(3);
  EXPECT_TRUE(loop->status().faults.empty());
}

TEST_F(RobotReach, ARecordingIsLookedForInItsMapWhileItMoves) {
  ASSERT_TRUE(go("first"));
  ticks(10);
  base->recording = true;  // it goes its way, whatever it is told
  loop->commands().stop();
  ASSERT_GT(loop->status().velocity.v_m_s, 0.1);
  const Status looked_for = loop->commands().relocalise(std::nullopt);
  EXPECT_TRUE(looked_for) << looked_for.error().message;
}

TEST_F(RobotReach, ALostWorldIsAFaultAtOnceAndGoneWithItsCause) {
  ticks(20);
  clock->link = fail(Errc::kLinkLost, "the world is gone");
  EXPECT_FALSE(await());
  ASSERT_EQ(loop->status().faults.size(), 1U);
  EXPECT_EQ(loop->status().faults.front().message, "the world is gone");
  EXPECT_EQ(component("lidar").state, api::ComponentState::kError);
  EXPECT_EQ(component("lidar").rate_hz, 0.0);
  EXPECT_EQ(component("pose").state, api::ComponentState::kActive);
  const auto refused = go("first");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::kNotReady);
  EXPECT_NE(refused.error().message.find("the world is gone"), std::string::npos);
  EXPECT_EQ(loop->commands().relocalise({}).error().code, Errc::kNotReady) << "no scan would come to find the place by";
  EXPECT_FALSE(await(std::chrono::minutes(5)));
  clock->link = {};
  EXPECT_TRUE(await());
  EXPECT_TRUE(loop->status().faults.empty());
  EXPECT_EQ(component("lidar").state, api::ComponentState::kActive);
  EXPECT_TRUE(go("first"));
}

TEST_F(RobotReach, AMissionOutlivesAShortLossOfTheWorldAndEndsWithALongOne) {
  ASSERT_TRUE(go("first"));
  ticks(5);
  clock->link = fail(Errc::kTimeout, "the world is silent");
  EXPECT_FALSE(await());
  EXPECT_FALSE(await(std::chrono::seconds(9)));
  clock->link = {};
  EXPECT_TRUE(await());
  ticks(5);
  EXPECT_FALSE(loop->status().mission->end);
  clock->link = fail(Errc::kTimeout, "the world is silent");
  EXPECT_FALSE(await());
  EXPECT_FALSE(await(std::chrono::seconds(11)));
  const std::optional<api::MissionEnd> end = loop->status().mission->end;
  ASSERT_TRUE(end);
  EXPECT_EQ(end->outcome, api::Outcome::kFault);
  EXPECT_EQ(end->cause, "the world is silent");
}

TEST_F(RobotReach, AWorldThatNeverComesBackEndsTheMissionAndSaysWhatToDo) {
  ASSERT_TRUE(go("first"));
  ticks(5);
  clock->link = fail(Errc::kCancelled, "another world is there");
  EXPECT_TRUE(await()) << "there is nothing to wait for";
  ASSERT_TRUE(loop->status().mission->end);
  EXPECT_EQ(loop->status().mission->end->cause, "another world is there");
  ASSERT_EQ(loop->status().faults.size(), 1U);
  EXPECT_NE(loop->status().faults.front().remedy.find("restart seekerd"), std::string::npos);
  EXPECT_FALSE(go("second"));
}

TEST_F(RobotReach, AMissionThatWasCutOffIsToldUntilAnotherOneBegins) {
  api::MissionRequest request;
  request.id = "round";
  request.task = api::ExploreMission{};
  EXPECT_FALSE(loop->status().cut_off);
  loop->mission_control().offer_unfinished(request);
  EXPECT_EQ(loop->status().cut_off, (api::CutOffMission{"round", "explore"}));
  ASSERT_TRUE(go("first"));
  EXPECT_FALSE(loop->status().cut_off);
}

TEST(RobotLog, MissionsAndFaultsAreLinesOfIt) {
  std::promise<void> fault;
  std::once_flag once;
  std::mutex mutex;
  std::vector<std::string> lines;
  const log::ScopedSink sink([&](const log::Line& line) {
    const std::lock_guard lock(mutex);
    lines.push_back(line.text);
    if (line.text.find("fault lidar-silent: ") == 0) {
      std::call_once(once, [&] { fault.set_value(); });
    }
  });
  const RobotOptions options = load_robot_options(source_file("config/robots/sim.yaml")).value();
  Assembly assembly = assemble(options).value();
  assembly.faults->lidar_silent = true;
  assembly.parts.behaviours = [](const api::MissionTask&, const Situation&) {
    return Result<std::unique_ptr<Behaviour>>(std::make_unique<StraightOn>());
  };
  Robot robot({}, options.loop, std::move(assembly.parts));
  robot.start();
  api::MissionRequest request;
  request.id = "go";
  request.task = api::GotoMission{.waypoints = {Point2(1, 0)}, .final_heading_rad = std::nullopt, .keep_out = {}};
  const auto session = robot.open({"tester", api::Role::kOperator});
  session->start_mission(request, [](const Result<api::MissionAccepted>& id) { EXPECT_TRUE(id); });
  ASSERT_EQ(fault.get_future().wait_for(std::chrono::seconds(60)), std::future_status::ready);
  std::promise<void> stopped;
  session->stop([&](const Status& /*done*/) { stopped.set_value(); });
  ASSERT_EQ(stopped.get_future().wait_for(std::chrono::seconds(60)), std::future_status::ready);
  robot.stop();
  const std::lock_guard lock(mutex);
  EXPECT_EQ(std::count(lines.begin(), lines.end(), "mission 'go' began: goto started"), 1);
  EXPECT_EQ(std::count_if(lines.begin(), lines.end(),
                          [](const std::string& line) { return line.find("mission 'go' ended: ") == 0; }),
            1);
}

}  // namespace
}  // namespace seeker::app
