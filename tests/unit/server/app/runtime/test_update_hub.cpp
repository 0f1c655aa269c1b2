#include "server/app/runtime/update_hub.hpp"

#include <gtest/gtest.h>

namespace seeker::app {
namespace {

TEST(UpdateHub, GateHoldsWhatTheJournalKeepsAndNothingElse) {
  UpdateHub hub;
  std::vector<std::function<void()>> held;
  std::vector<std::pair<api::Topic, std::uint64_t>> told;
  const auto subscription =
      hub.subscribe({{.topic = api::Topic::kStatus},
                     {.topic = api::Topic::kMission},
                     {.topic = api::Topic::kEvent},
                     {.topic = api::Topic::kDetection}},
                    [&](const api::UpdatePtr& update) { told.emplace_back(update->topic, update->sequence); });
  hub.set_gate([&](std::function<void()> deliver) { held.push_back(std::move(deliver)); });
  hub.publish(api::Topic::kEvent, {}, api::Event{});
  hub.publish(api::Topic::kMission, {}, api::MissionStatus{});
  hub.publish(api::Topic::kDetection, {}, api::Detection{});
  hub.publish(api::Topic::kEvent, {}, api::Event{});
  hub.publish(api::Topic::kStatus, {}, api::RobotStatus{});
  EXPECT_EQ(told, (std::vector<std::pair<api::Topic, std::uint64_t>>{{api::Topic::kStatus, 1}}));
  ASSERT_EQ(held.size(), 4U);
  told.clear();
  for (const auto& deliver : held) {
    deliver();
  }
  EXPECT_EQ(
      told,
      (std::vector<std::pair<api::Topic, std::uint64_t>>{
          {api::Topic::kEvent, 1}, {api::Topic::kMission, 1}, {api::Topic::kDetection, 1}, {api::Topic::kEvent, 2}}));
}

}  // namespace
}  // namespace seeker::app
