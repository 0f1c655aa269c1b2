// A fleet whose robots show certificates of their site.

#include <gmock/gmock.h>

#include "common/rpc/fleet_client.hpp"
#include "server/app/fleet/fleet_part.hpp"
#include "tests/integration/fleet/fleet_world.hpp"
#include "tests/support/net/site.hpp"

namespace seeker::testing {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

class FleetTls : public ::testing::Test {
 protected:
  FleetTls() {
    app::FleetSettings settings;
    settings.lead = true;
    settings.port = 0;
    settings.share_period = settings.floor_period = 20ms;
    settings.security.files = site_.issue("main", pki::Role::kRobot, {"127.0.0.1"});
    settings.security.check_period = 20ms;
    const std::filesystem::path folder = fresh_folder("fleet_tls");
    auto started = app::start_fleet(settings, "main", "test", folder, host_.host());
    EXPECT_TRUE(started) << started.error().message;
    main_ = std::move(*started);
    main_files_ = settings.security.files;
    port_ = static_cast<std::uint16_t>(std::stoi(wait_for_file(folder / "port", std::chrono::seconds(10)).value()));
  }
  [[nodiscard]] app::FleetPart robot(const std::string& robot_id, const pki::BundleFiles& files) const {
    app::FleetSettings settings;
    settings.join = "127.0.0.1:" + std::to_string(port_);
    settings.period = settings.share_period = settings.floor_period = 20ms;
    settings.security.files = files;
    auto started = app::start_fleet(settings, robot_id, "test", {}, holds(east()));
    EXPECT_TRUE(started) << started.error().message;
    return std::move(*started);
  }
  [[nodiscard]] rpc::FleetClient client(const std::optional<pki::BundleFiles>& tls) const {
    return {{"127.0.0.1", port_}, 10s, tls};
  }
  /// Waits until the robot has an outcome that holds these words.
  static void expect_outcome(const app::FleetPart& robot, const std::string& words) {
    for (;;) {
      const Result<api::FleetStatus> status = robot.follower->status();
      ASSERT_FALSE(status) << "it must not get in";
      if (status.error().message.find(words) != std::string::npos) {
        return;
      }
      std::this_thread::yield();
    }
  }

  TestSite site_;
  ToyHost host_{west()};
  pki::BundleFiles main_files_;
  app::FleetPart main_;
  std::uint16_t port_ = 0;
};

TEST_F(FleetTls, ARobotJoinsWithItsCertificate) {
  const app::FleetPart joined = robot("r1", site_.issue("r1", pki::Role::kRobot));
  static_cast<void>(until(*main_.leader, "r1", [](const auto& m) { return m.linked; }));
}

TEST_F(FleetTls, ARobotSpeaksForItselfAlone) {
  const app::FleetPart liar = robot("r2", site_.issue("r1", pki::Role::kRobot));
  expect_outcome(liar, "does not allow to speak for the robot 'r2'");
  const app::FleetPart person = robot("anna", site_.issue("anna", pki::Role::kAdmin));
  expect_outcome(person, "--role robot");
}

TEST_F(FleetTls, ReadingNeedsACertificateAndDecidingAnOperators) {
  EXPECT_TRUE(client(site_.issue("olga", pki::Role::kObserver)).status());
  const api::FleetDecision split{"r1", api::FleetVerb::kSplit, 0};
  const auto refused = client(site_.issue("olga", pki::Role::kObserver)).decide(split);
  EXPECT_EQ(refused.error().code, Errc::kRefused);
  EXPECT_THAT(refused.error().message, HasSubstr("--role operator"));
  const auto unknown = client(site_.issue("anna", pki::Role::kOperator)).decide(split);
  EXPECT_EQ(unknown.error().code, Errc::kNotFound) << "the operator may; there is no such robot";
  EXPECT_THAT(client(std::nullopt).status().error().message, HasSubstr("--tls"));
  const std::vector<api::AuditRecord> decisions = host_.decisions();
  ASSERT_EQ(decisions.size(), 2U) << "who decided is known, also of what was refused";
  EXPECT_EQ(decisions[0].certificate, "olga");
  EXPECT_EQ(decisions[0].outcome, "refused");
  EXPECT_EQ(decisions[0].essentials, "split: 'r1'");
  EXPECT_EQ(decisions[1].certificate, "anna");
  EXPECT_EQ(decisions[1].role, "operator");
  EXPECT_EQ(decisions[1].outcome, "not_found");
}

TEST_F(FleetTls, ARevokedRobotIsShutOut) {
  const app::FleetPart joined = robot("r1", site_.issue("r1", pki::Role::kRobot));
  static_cast<void>(until(*main_.leader, "r1", [](const auto& m) { return m.linked; }));
  site_.revoke("r1");
  site_.copy_revocations(main_files_);
  for (;;) {
    const Result<api::FleetStatus> status = joined.follower->status();
    if (!status) {
      EXPECT_EQ(status.error().code, Errc::kRefused) << status.error().message;
      break;
    }
    const auto members = main_.leader->status().members;
    if (std::any_of(members.begin(), members.end(), [](const auto& m) { return m.robot_id == "r1" && !m.linked; })) {
      break;
    }
    std::this_thread::yield();
  }
}

}  // namespace
}  // namespace seeker::testing
