// seeker components: ports, settings, types and states.

#include <gtest/gtest.h>

#include "tests/unit/client/cli/verbs_fixture.hpp"

namespace seeker::cli {
namespace {

class ComponentVerbs : public VerbsFixture {};

TEST_F(ComponentVerbs, ComponentsShowTheirPortsAndWhoIsConnected) {
  const std::string text = run({"components"}).out;
  EXPECT_NE(text.find("odometry       out Odometry"), std::string::npos) << text;
  EXPECT_NE(text.find("to pose.odometry"), std::string::npos) << text;
  EXPECT_NE(text.find("not connected"), std::string::npos) << text;
  const std::string json = run({"components", "--json"}).out;
  EXPECT_NE(json.find(R"("connected":["pose.odometry"],"rate_hz":10.0,"age_s":0.02)"), std::string::npos) << json;
}

TEST_F(ComponentVerbs, SettingsOfComponentsAreReadAndChanged) {
  EXPECT_NE(run({"components", "get", "base"}).out.find("after a restart of seekerd"), std::string::npos);
  const Ran changed = run({"components", "set", "base", "timeout_s=0.7", "--json"});
  EXPECT_EQ(changed.code, 0) << changed.err;
  EXPECT_NE(changed.out.find(R"("key":"timeout_s","value":"0.7","path":"loop.base_timeout_s","effect":"NOW")"),
            std::string::npos)
      << changed.out;
  const Ran refused = run({"components", "set", "base", "timeout_s=bad"});
  EXPECT_NE(refused.code, 0);
  EXPECT_NE(refused.err.find("loop.base_timeout_s: expected a number"), std::string::npos) << refused.err;
  EXPECT_EQ(run({"components", "get", "radar"}).code, 1);
  EXPECT_EQ(run({"components", "set", "base"}).code, 2) << "nothing to set";
}

TEST_F(ComponentVerbs, ComponentsAreExchangedAndSwitched) {
  EXPECT_EQ(run({"components", "exchange", "base", "other"}).code, 0);
  EXPECT_EQ(run({"components", "deactivate", "base"}).code, 0);
  EXPECT_EQ(host->values().components.front().type, "other");
  EXPECT_EQ(host->values().components.front().state, api::ComponentState::kInactive);
  EXPECT_EQ(run({"components", "activate", "base"}).code, 0);
  EXPECT_EQ(host->values().components.front().state, api::ComponentState::kActive);
  EXPECT_EQ(run({"components", "activate", "radar"}).code, 1);
}

}  // namespace
}  // namespace seeker::cli
