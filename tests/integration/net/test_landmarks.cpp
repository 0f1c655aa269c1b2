#include "tests/integration/net/fixture.hpp"

namespace seeker::testing {
namespace {

class LandmarkCallsTest : public NetTest {
 protected:
  LandmarkCallsTest() {
    robot_.edit([this](FakeRobotValues& v) { v.landmarks["lab"] = landmarks_; });
  }
  std::vector<api::LandmarkPoint> landmarks_{{1, {1.0, 2.0}, 0.5, 0.02, 5}, {7, {-1.0, 2.5}, 1.5, 0.1, 1}};
};

TEST_F(LandmarkCallsTest, ValuesComeBackAsTheRobotHasThem) {
  start();
  const auto client = connect("tester");
  const auto all = ask<std::vector<api::LandmarkSummary>>([&](auto r) { client->list_landmarks(r); });
  ASSERT_TRUE(all) << all.error().message;
  ASSERT_EQ(all->size(), 1U);
  EXPECT_EQ(ask<api::LandmarkSummary>([&](auto r) { client->inspect_landmarks("lab", true, r); }), all->front());
  EXPECT_EQ(ask<std::vector<api::LandmarkPoint>>([&](auto r) { client->get_landmarks("lab", r); }), landmarks_);
  EXPECT_EQ(ask<api::LandmarkSummary>([&](auto r) { client->prune_landmarks("lab", 3, r); })->landmarks, 1U);
  EXPECT_EQ(ask<api::LandmarkSummary>([&](auto r) { client->revert_landmarks("lab", r); })->landmarks, 2U);
  EXPECT_EQ(ask<api::LandmarkSummary>([&](auto r) { client->revert_landmarks("lab", r); }).error().code,
            Errc::kNotReady);
  EXPECT_TRUE(ask<void>([&](auto r) { client->delete_landmarks("lab", r); }));
  EXPECT_TRUE(robot_.values().landmarks.empty());
}

TEST_F(LandmarkCallsTest, RefusalsKeepTheirCodeAndWrongNamesDoNotReachTheRobot) {
  start();
  const auto client = connect("tester");
  const auto unknown = ask<std::vector<api::LandmarkPoint>>([&](auto r) { client->get_landmarks("cellar", r); });
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().code, Errc::kNotFound);
  const std::size_t calls = robot_.values().calls.size();
  EXPECT_EQ(ask<void>([&](auto r) { client->delete_landmarks("../etc", r); }).error().code, Errc::kInvalidArgument);
  EXPECT_EQ(ask<api::LandmarkSummary>([&](auto r) { client->prune_landmarks("lab", 0, r); }).error().code,
            Errc::kInvalidArgument);
  EXPECT_EQ(robot_.values().calls.size(), calls);
  for (const Errc code : {Errc::kCorrupt, Errc::kUnsupportedVersion, Errc::kIo, Errc::kBusy, Errc::kNotReady}) {
    robot_.edit([&](FakeRobotValues& v) { v.failure = Error{code, "the cause; the remedy"}; });
    const auto failed = ask<api::LandmarkSummary>([&](auto r) { client->inspect_landmarks("lab", true, r); });
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error(), (Error{code, "the cause; the remedy"}));
  }
}

TEST_F(LandmarkCallsTest, ObserverLooksButDeletesNothing) {
  params_.max_role = api::Role::kObserver;
  start();
  const auto client = connect("watcher");
  EXPECT_TRUE(ask<std::vector<api::LandmarkPoint>>([&](auto r) { client->get_landmarks("lab", r); }));
  EXPECT_EQ(ask<void>([&](auto r) { client->delete_landmarks("lab", r); }).error().code, Errc::kRefused);
  EXPECT_EQ(ask<api::LandmarkSummary>([&](auto r) { client->prune_landmarks("lab", 3, r); }).error().code,
            Errc::kRefused);
  EXPECT_EQ(ask<api::LandmarkSummary>([&](auto r) { client->revert_landmarks("lab", r); }).error().code,
            Errc::kRefused);
}

}  // namespace
}  // namespace seeker::testing
