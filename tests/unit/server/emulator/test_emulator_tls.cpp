#include <thread>

#include <gmock/gmock.h>

#include "server/drivers/emulator/emulator_link.hpp"
#include "server/emulator/emulator_server.hpp"
#include "tests/support/net/site.hpp"
#include "tests/unit/server/emulator/worlds.hpp"

namespace seeker::emulator {
namespace {

using ::seeker::testing::TestSite;
using ::testing::HasSubstr;

class EmulatorTls : public ::testing::Test {
 protected:
  EmulatorTls() {
    const Result<std::uint16_t> opened = server_.listen();
    EXPECT_TRUE(opened) << opened.error().message;
    port_ = opened.value_or(0);
    thread_ = std::thread([this] { server_.run(); });
  }
  ~EmulatorTls() override {
    server_.stop();
    thread_.join();
  }
  [[nodiscard]] auto connect(const std::optional<pki::BundleFiles>& tls) const {
    drivers::EmulatorParams params;
    params.port = port_;
    params.tls = tls;
    return drivers::EmulatorLink::connect(params);
  }
  [[nodiscard]] net::LinkSecurity security() {
    net::LinkSecurity security;
    security.files = site_.robot();
    return security;
  }

  TestSite site_;
  WorldHost host_{testing::two_robots(), {.world_id = 1}};
  EmulatorServer server_{host_, {.port = 0, .security = security()}};
  std::uint16_t port_ = 0;
  std::thread thread_;
};

TEST_F(EmulatorTls, ARobotEntersWithItsCertificate) {
  const auto link = connect(site_.issue("r2", pki::Role::kRobot));
  ASSERT_TRUE(link) << link.error().message;
  EXPECT_TRUE((*link)->reachable());
}

TEST_F(EmulatorTls, OthersStayOutside) {
  EXPECT_THAT(connect(site_.issue("anna", pki::Role::kAdmin)).error().message, HasSubstr("--role robot"));
  EXPECT_FALSE(connect(std::nullopt));
  TestSite other;
  EXPECT_THAT(connect(other.issue("r2", pki::Role::kRobot)).error().message, HasSubstr("another site's CA"));
}

}  // namespace
}  // namespace seeker::emulator
