// The lease on the command line: shown, held, asked for, answered; and link policies as lists.

#include <gtest/gtest.h>

#include "tests/unit/client/cli/cli_fixture.hpp"

namespace seeker::cli {
namespace {

class LeaseVerbs : public ::testing::Test, public CliFixture {
 protected:
  void give_to(const std::string& owner) {
    host->edit([&](testing::FakeRobotValues& v) {
      v.lease = {};
      v.lease.owner = owner;
      v.lease.epoch = 7;
    });
  }
  [[nodiscard]] std::string owner() const { return host->values().lease.owner; }
};

TEST_F(LeaseVerbs, TheLeaseIsShownWithWhoAsksForIt) {
  EXPECT_EQ(run({"lease"}).out, "nobody\n");
  give_to("anna");
  host->edit([](testing::FakeRobotValues& v) {
    v.lease.requested_by = "ben";
    v.lease.request_left = std::chrono::seconds(8);
  });
  EXPECT_EQ(run({"lease"}).out, "anna; 'ben' asks for it, 8 s to answer\n");
  const Ran json = run({"lease", "--json"});
  EXPECT_TRUE(is_json(json.out)) << json.out;
  EXPECT_NE(json.out.find(R"("requested_by":"ben")"), std::string::npos) << json.out;
  host->edit(
      [](testing::FakeRobotValues& v) { v.lease = {.owner = "anna", .epoch = 8, .requested_by = "", .stale = true}; });
  EXPECT_NE(run({"lease"}).out.find("others may acquire it"), std::string::npos);
}

TEST_F(LeaseVerbs, AcquireHoldsItForATimeAndGivesItBack) {
  std::string held_by;
  const Ran ran = run({"lease", "acquire", "--for", "0.3"}, [&] {
    while ((held_by = owner()).empty()) {
      std::this_thread::yield();
    }
  });
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(held_by, "seeker-test");
  EXPECT_EQ(owner(), "");
}

TEST_F(LeaseVerbs, HolderRefreshesAStaleLeaseAndEndsWhenItIsTaken) {
  const Ran ran = run({"lease", "acquire"}, [&] {
    while (owner().empty()) {
      std::this_thread::yield();
    }
    host->edit([](testing::FakeRobotValues& v) { v.lease.stale = true; });
    while (host->values().lease.stale) {
      std::this_thread::yield();
    }
    give_to("anna");
  });
  EXPECT_EQ(ran.code, 3);
  EXPECT_NE(ran.err.find("'anna' holds the lease now"), std::string::npos) << ran.err;
}

TEST_F(LeaseVerbs, ALeaseInOtherHandsIsRefusedWithItsOwner) {
  give_to("anna");
  const Ran ran = run({"lease", "acquire", "--for", "1"});
  EXPECT_EQ(ran.code, 3);
  EXPECT_NE(ran.err.find("'anna'"), std::string::npos) << ran.err;
}

TEST_F(LeaseVerbs, RequestWaitsForTheAnswerAndADenialIsARefusal) {
  give_to("anna");
  const Ran ran = run({"lease", "request"}, [this] {
    while (host->values().lease.requested_by != "seeker-test") {
      std::this_thread::yield();
    }
    host->edit([](testing::FakeRobotValues& v) { v.lease.requested_by.clear(); });
  });
  EXPECT_EQ(ran.code, 3);
  EXPECT_NE(ran.err.find("'anna' keeps the lease"), std::string::npos) << ran.err;
}

TEST_F(LeaseVerbs, LinkPolicyIsAListOrItsShortForm) {
  EXPECT_EQ(run({"goto", "1,0", "--link-policy", "2:event,5:pause,30:return", "--detach", "--id", "a"}).code, 0);
  ASSERT_EQ(host->values().missions.size(), 1U);
  EXPECT_EQ(host->values().missions[0].link_steps, api::parse_link_steps("2:event,5:pause,30:return").value());
  const Ran wrong = run({"goto", "1,0", "--link-policy", "5:jump", "--detach"});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_NE(wrong.err.find("5:jump"), std::string::npos) << wrong.err;
}

}  // namespace
}  // namespace seeker::cli
