// Faults and events: told once when they come and when they go, numbered for subscribers.

#include <gtest/gtest.h>

#include "server/app/loop/diagnostics.hpp"
#include "tests/unit/server/app/loop/fake_robot.hpp"

namespace seeker::app {
namespace {

class DiagnosticsTest : public ::testing::Test {
 protected:
  DiagnosticsTest() {
    hooks.on_event = [this](const api::Event& event) { events.push_back(event); };
  }

  std::shared_ptr<testing::HandClock> clock = std::make_shared<testing::HandClock>();
  UpdateHub hub;
  LoopHooks hooks;
  std::vector<api::Event> events;
  Diagnostics diagnostics{clock, hub, hooks};
};

TEST_F(DiagnosticsTest, AFaultIsAnEventWhenItComesAndWhenItGoes) {
  diagnostics.raise("lidar-silent", "lidar", "nothing comes", "check the cable");
  diagnostics.raise("lidar-silent", "lidar", "nothing comes", "check the cable");
  ASSERT_EQ(events.size(), 1U) << "one that lasts is told once";
  EXPECT_EQ(events[0].kind, "fault");
  EXPECT_EQ(events[0].stamp, clock->time);
  EXPECT_TRUE(diagnostics.clear("lidar-silent"));
  EXPECT_FALSE(diagnostics.clear("lidar-silent"));
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[1].kind, "fault-cleared");
}

TEST_F(DiagnosticsTest, SubscribersSeeWhetherTheyMissedAnEvent) {
  std::vector<std::uint64_t> numbers;
  const auto subscription = hub.subscribe({api::TopicRequest{.topic = api::Topic::kEvent}},
                                          [&](const std::shared_ptr<const api::Update>& update) {
                                            numbers.push_back(std::get<api::Event>(update->payload).sequence);
                                          });
  diagnostics.log("one", "first");
  diagnostics.log("two", "second");
  EXPECT_EQ(numbers, (std::vector<std::uint64_t>{1, 2}));
}

TEST_F(DiagnosticsTest, ARefusedReadingIsAWarningThatAnAcceptedOneClears) {
  diagnostics.note_reading(fail(Errc::kInvalidArgument, "time runs backwards"), "odometry-refused");
  ASSERT_TRUE(diagnostics.faults().find("odometry-refused"));
  EXPECT_EQ(diagnostics.faults().blocking(), nullptr) << "the robot may go on";
  diagnostics.note_reading({}, "odometry-refused");
  EXPECT_TRUE(diagnostics.faults().all().empty());
}

}  // namespace
}  // namespace seeker::app
