// Certificates made by `seeker pki`, a daemon that asks for them, a client that shows one, and OpenSSL's own client as
// a third party.
#include <csignal>

#include <gmock/gmock.h>

#include "tests/integration/processes/daemon.hpp"

namespace seeker::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr int kExitConfig = 78;
constexpr int kExitRefused = 3;

struct Ended {
  int code = -1;
  std::string text;
};

Ended run(const fs::path& file, const std::vector<std::string>& arguments) {
  ChildProcess process(file, arguments, fresh_folder("run") / "out");
  const std::optional<int> code = process.wait(kStart);
  return {code.value_or(-1), process.output()};
}

/// A site with a robot and an operator, made on the command line.
class TlsProcesses : public ::testing::Test {
 protected:
  void SetUp() override {
    pki({"init", site_});
    pki({"issue", "sim-1", "--role", "robot", "--host", "127.0.0.1"});
    pki({"issue", "anna", "--role", "operator"});
    pki({"issue", "olga", "--role", "observer"});
  }
  void pki(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "pki");
    if (arguments[1] != "init") {
      arguments.insert(arguments.end(), {"--site", site_});
    }
    const Ended ended = run(program("seeker"), arguments);
    EXPECT_EQ(ended.code, 0) << ended.text;
  }
  [[nodiscard]] std::string bundle(const std::string& name) const { return site_ / "bundles" / name; }
  /// What the robot is started with.
  [[nodiscard]] std::vector<std::string> settings() const { return tls_settings(pki::bundle_in(bundle("sim-1"))); }

  fs::path site_ = fresh_folder("tls") / "site";
};

TEST_F(TlsProcesses, ARobotIsCommandedByThoseWhomItsSiteAllows) {
  Daemon daemon(settings());
  std::string text;
  EXPECT_EQ(seeker(daemon, {"status", "--tls", bundle("anna")}, &text), 0) << text;
  EXPECT_EQ(seeker(daemon, {"drive", "0.1", "0", "--for", "0.2", "--tls", bundle("olga")}, &text), kExitRefused);
  EXPECT_THAT(text, HasSubstr("--role operator"));
  EXPECT_EQ(seeker(daemon, {"status"}, &text), kExitRefused);
  EXPECT_THAT(text, HasSubstr("--tls"));
  EXPECT_EQ(seeker(daemon, {"status", "--tls", site_}, &text), 2);
  EXPECT_THAT(text, HasSubstr("holds no cert.pem"));

  pki({"revoke", "anna"});
  fs::copy_file(site_ / "crl.pem", bundle("sim-1") + "/crl.pem", fs::copy_options::overwrite_existing);
  // The robot looks once a second; a session that it ends meanwhile is a lost link.
  constexpr int kLooks = 50;
  int code = 0;
  for (int look = 0; look < kLooks && code != kExitRefused; ++look) {
    code = seeker(daemon, {"status", "--tls", bundle("anna")}, &text);
  }
  EXPECT_EQ(code, kExitRefused);
  EXPECT_THAT(text, HasSubstr("was revoked"));
  EXPECT_EQ(seeker(daemon, {"status", "--tls", bundle("olga")}, &text), 0) << text;
  daemon.process->send(SIGTERM);
  EXPECT_EQ(daemon.process->wait(kStart), 0) << daemon.process->output();
}

TEST_F(TlsProcesses, OpenSslShakesHandsByTls13Only) {
  const fs::path openssl = "/usr/bin/openssl";
  if (!fs::exists(openssl)) {
    GTEST_SKIP() << "no /usr/bin/openssl: install the Debian package openssl";
  }
  Daemon daemon(settings());
  const auto s_client = [&](const std::string& version) {
    return run(openssl, {"s_client", "-connect", daemon.address(), version, "-CAfile", bundle("anna") + "/ca.pem",
                         "-cert", bundle("anna") + "/cert.pem", "-key", bundle("anna") + "/key.pem",
                         "-verify_return_error", "-verify_ip", "127.0.0.1"});
  };
  const Ended good = s_client("-tls1_3");
  EXPECT_THAT(good.text, HasSubstr("Verification: OK"));
  EXPECT_THAT(good.text, HasSubstr("TLSv1.3"));
  const Ended old = s_client("-tls1_2");
  EXPECT_NE(old.code, 0);
  EXPECT_THAT(old.text, HasSubstr("alert protocol version"));
}

TEST_F(TlsProcesses, APortThatEverybodyReachesIsNotOpenedInSilence) {
  const std::string config = source_file("config/robots/sim.yaml");
  const fs::path state = fresh_folder("state");
  const Ended refused =
      run(program("seekerd"), {"--config", config, "--port", "0", "--state", state, "--set", "server.address=0.0.0.0"});
  EXPECT_EQ(refused.code, kExitConfig);
  EXPECT_THAT(refused.text, HasSubstr("seeker pki"));
  const Ended missing = run(program("seekerd"), {"--config", config, "--port", "0", "--state", state, "--set",
                                                 "server.tls.certificate=none.pem", "--set", "server.tls.key=none.pem",
                                                 "--set", "server.tls.ca=none.pem"});
  EXPECT_EQ(missing.code, kExitConfig);
  EXPECT_THAT(missing.text, HasSubstr("none.pem"));

  Daemon loud({"--set", "server.address=0.0.0.0", "--set", "server.insecure=true"});
  EXPECT_THAT(loud.process->output(), HasSubstr("INSECURE"));
  std::string text;
  EXPECT_EQ(seeker(loud, {"status", "--tls", "none"}, &text), 0) << text;
  EXPECT_THAT(text, HasSubstr("may command the robot"));
}

}  // namespace
}  // namespace seeker::testing
