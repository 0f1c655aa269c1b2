// A robot as a process whose port is tormented, with TLS and without. SEEKER_ABUSE says how many connections attack
// (default 300); from 10000 on it runs long enough for the periods of the control loop to be compared with quiet ones.

#include <future>
#include <iostream>
#include <sstream>
#include <thread>

#include <gmock/gmock.h>

#include "tests/integration/processes/abuser.hpp"
#include "tests/integration/processes/metrics_page.hpp"
#include "tests/support/environment.hpp"
#include "tests/support/process_memory.hpp"

namespace seeker::testing {
namespace {

using ::testing::HasSubstr;

constexpr std::uint64_t kSeed = 11;
constexpr int kWhole = 10'000;

int attackers() { return number_from_environment("SEEKER_ABUSE", 300); }
bool whole() { return attackers() >= kWhole; }

class AbuseProcesses : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kCurl)) {
      GTEST_SKIP() << "curl is not installed";
    }
    std::cout << "seed " << kSeed << ", " << attackers() << " connections\n";
  }
  void start(std::vector<std::string> settings) {
    settings.insert(settings.end(), {"--set", "metrics.port=0", "--set", "sim.people=false"});
    daemon_.emplace(settings, fresh_folder("abuse"), source_file("config/robots/live.yaml"));
    port_ = static_cast<std::uint16_t>(std::stoi(daemon_->port));
  }
  [[nodiscard]] Result<std::shared_ptr<rpc::RobotClient>> connect(const std::optional<pki::BundleFiles>& tls) {
    rpc::ClientParams params;
    params.client_name = "good-" + std::to_string(++clients_);
    params.tls = tls;
    params.connect_timeout = params.call_timeout = kCall;
    params.on_link = [this](const rpc::LinkEvent& event) { links_.add(event); };
    return rpc::RobotClient::connect({"127.0.0.1", port_}, params);
  }
  [[nodiscard]] LoopPeriods periods() { return LoopPeriods(read_page(page_of(*daemon_))); }
  /// The periods of so many seconds.
  template <class Work>
  [[nodiscard]] LoopPeriods periods_during(Work&& work) {
    const LoopPeriods before = periods();
    work();
    return periods().since(before);
  }
  /// Torments the port by `offence`, and judges what became of the robot meanwhile.
  template <class Offence>
  void attack(const std::optional<pki::BundleFiles>& tls, Offence&& offence) {
    const auto inside = connect(tls);
    ASSERT_TRUE(inside) << inside.error().message;
    const LoopPeriods quiet = periods_during([&] { stay_quiet(); });
    const std::optional<long> before_kb = memory_kb(daemon_->process->pid(), "VmRSS");
    ASSERT_TRUE(before_kb);
    const auto begin = std::chrono::steady_clock::now();
    const LoopPeriods under_attack = periods_during([&] {
      torment(std::forward<Offence>(offence), [&] {
        const auto late = connect(tls);
        EXPECT_TRUE(late) << late.error().message;
      });
    });
    expect_unharmed(**inside);
    expect_memory_bounded(*before_kb);
    expect_few_lines(std::chrono::steady_clock::now() - begin);
    if (whole()) {
      compare(quiet, under_attack);
    }
  }
  static std::chrono::seconds watched() { return whole() ? std::chrono::seconds(60) : std::chrono::seconds(0); }
  static void stay_quiet() {
    std::promise<void> never;
    static_cast<void>(never.get_future().wait_for(watched()));
  }
  /// As many offences as asked for, and for a minute at least where the loop is watched; `honest` is called now and
  /// then, amid the storm.
  template <class Offence, class Honest>
  void torment(Offence&& offence, Honest&& honest) {
    constexpr int kEvery = 100;
    const std::size_t loris_connections = whole() ? 500 : 50;
    const auto end = std::chrono::steady_clock::now() + watched();
    std::thread attacker([&] {
      if (whole()) {
        be_another_machine();
      }
      SlowLoris loris(port_, loris_connections);
      try {
        for (int k = 0; k < attackers() || std::chrono::steady_clock::now() < end; ++k) {
          if (k % kEvery == 0) {
            loris.go_on();
          }
          offence(k);
        }
      } catch (const std::exception& error) {
        ADD_FAILURE() << "the attacker cannot go on: " << error.what();
      }
    });
    honest();
    attacker.join();
    honest();
  }

  void expect_unharmed(rpc::RobotClient& inside) {
    EXPECT_EQ(inside.link(), rpc::LinkState::kConnected);
    const auto status = rpc::wait<api::RobotStatus>([&](auto reply) { inside.get_status(std::move(reply)); }, kCall);
    EXPECT_TRUE(status) << status.error().message;
    for (const rpc::LinkEvent& event : links_.items()) {
      EXPECT_NE(event.state, rpc::LinkState::kLost) << event.why;
    }
  }
  void expect_memory_bounded(long before_kb) {
    constexpr long kMost_kb = 64L * 1024;
    const std::optional<long> most_kb = memory_kb(daemon_->process->pid(), "VmHWM");
    ASSERT_TRUE(most_kb);
    std::cout << "memory " << before_kb << " kB before, " << *most_kb << " kB at most\n";
    EXPECT_LT(*most_kb - before_kb, kMost_kb);
  }
  void expect_few_lines(Duration took) {
    std::istringstream log(daemon_->process->output());
    int lines = 0;
    for (std::string line; std::getline(log, line);) {
      lines += line.find(" refused: ") != std::string::npos || line.find(" refused, the last: ") != std::string::npos;
    }
    std::cout << lines << " lines about refusals in " << to_seconds(took) << " s\n";
    EXPECT_GT(lines, 0) << "nobody is told";
    EXPECT_LE(lines, to_seconds(took) + 2.0);
  }
  static void compare(const LoopPeriods& quiet, const LoopPeriods& under_attack) {
    constexpr double kMedian = 1.02;
    constexpr double kTail = 1.10;
    for (const auto& [share, most] : {std::pair(0.5, kMedian), std::pair(0.99, kTail)}) {
      std::cout << "period of the loop, quantile " << share << ": " << 1e3 * quiet.quantile_s(share)
                << " ms when it is quiet (" << quiet.count() << " passes), " << 1e3 * under_attack.quantile_s(share)
                << " ms under attack (" << under_attack.count() << ")\n";
      EXPECT_LE(under_attack.quantile_s(share), most * quiet.quantile_s(share));
    }
  }

  std::optional<Daemon> daemon_;
  std::uint16_t port_ = 0;
  int clients_ = 0;
  Recorder<rpc::LinkEvent> links_;
};

TEST_F(AbuseProcesses, APlainPortBearsGarbageAndSlowConnections) {
  start({});
  BadBytes bad(kSeed);
  attack(std::nullopt, [&](int) { offend(port_, bad.next()); });
}

/// The certificates of a site, the good and the bad ones.
class TlsAbuseProcesses : public AbuseProcesses {
 protected:
  void start_with_tls() {
    site_.issue("gone", pki::Role::kAdmin);
    site_.revoke("gone");
    site_.copy_revocations(robot_);
    // The attackers share this machine's address with the honest: nobody is shut out.
    std::vector<std::string> settings = tls_settings(robot_);
    settings.insert(settings.end(), {"--set", "server.tls.lockout.loopback=false"});
    start(std::move(settings));
  }
  /// Every twentieth takes the trouble of a handshake: the others are as cheap as their maker can have them.
  void offence(int k) {
    constexpr int kEvery = 20;
    if (k % kEvery != 0) {
      // Longer than what the head of a record promises: nothing more is waited for.
      const std::string head = k % 2 == 0 ? "" : std::string("\x16\x03\x01\x02\x00\x01", 6);
      offend(port_, head + bad_.next() + filling_);
      return;
    }
    switch ((k / kEvery) % 6) {
      case 0: static_cast<void>(TlsPeer(port_, std::nullopt).end()); break;
      case 1: static_cast<void>(TlsPeer(port_, other_).end()); break;
      case 2: static_cast<void>(TlsPeer(port_, revoked_).end()); break;
      case 3: static_cast<void>(TlsPeer(port_, expired_).end()); break;
      case 4: offend(port_, recorded_); break;
      default: offend_inside(port_, observer_, bad_.next()); break;
    }
  }

  TestSite site_;
  TestSite other_site_;
  BadBytes bad_{kSeed};
  pki::BundleFiles robot_ = site_.issue("live-1", pki::Role::kRobot, {"127.0.0.1"});
  pki::BundleFiles good_ = site_.issue("anna", pki::Role::kOperator);
  pki::BundleFiles observer_ = site_.issue("olga", pki::Role::kObserver);
  pki::BundleFiles revoked_ = site_.issue("gone", pki::Role::kAdmin);
  pki::BundleFiles expired_ = site_.issue_expired("late", pki::Role::kAdmin);
  pki::BundleFiles other_ = other_site_.issue("mallory", pki::Role::kAdmin);
  std::string recorded_;
  std::string filling_ = std::string(700, 'x');
};

TEST_F(TlsAbuseProcesses, APortWithTlsBearsThemAndThoseWithoutAGoodCertificate) {
  start_with_tls();
  recorded_ = recorded_client_bytes(port_, good_);
  const auto observer = connect(observer_);
  ASSERT_TRUE(observer) << observer.error().message;
  const auto refused = rpc::wait<void>([&](auto reply) { (*observer)->set_estop(false, std::move(reply)); }, kCall);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::kRefused) << refused.error().message;
  attack(good_, [this](int k) { offence(k); });
}

}  // namespace
}  // namespace seeker::testing
