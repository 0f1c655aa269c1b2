// What an operator reaches over a link of each kind, one impairment at a time and level by level, as ASTM F3243 has
// impairments of the communication swept. SEEKER_SWEEP names the file for the table; without it a few levels are tried.

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iostream>

#include <fmt/format.h>

#include "tests/integration/link/follower.hpp"
#include "tests/integration/link/linked_robot.hpp"
#include "tests/support/net/chaos_proxy.hpp"
#include "tests/support/process.hpp"
#include "tests/support/quantile.hpp"

namespace seeker::testing {
namespace {

struct Level {
  const char* kind;
  const char* level;
  Impairment impairment;
};

/// The first kFew are tried in every run.
constexpr std::size_t kFew = 3;
std::vector<Level> levels() {
  constexpr double kBit_per_s = 1.0 / 8.0;
  return {
      {"none", "-", {}},
      {"delay", "20 ms", {.delay = milliseconds(20)}},
      {"cut", "every 100 kB", {.cut_at = 100'000}},
      {"delay", "100 ms", {.delay = milliseconds(100)}},
      {"delay", "200 ms", {.delay = milliseconds(200)}},
      {"delay", "500 ms", {.delay = milliseconds(500)}},
      {"jitter", "50 ms", {.jitter = milliseconds(50)}},
      {"jitter", "200 ms", {.jitter = milliseconds(200)}},
      {"bandwidth", "1 Mbit/s", {.bytes_per_s = 1e6 * kBit_per_s}},
      {"bandwidth", "256 kbit/s", {.bytes_per_s = 256e3 * kBit_per_s}},
      {"bandwidth", "64 kbit/s", {.bytes_per_s = 64e3 * kBit_per_s}},
      {"pieces", "1 byte", {.piece = 1}},
      {"cut", "every 10 kB", {.cut_at = 10'000}},
      {"cut", "every 3 kB", {.cut_at = 3'000}},
      {"half-open", "every 100 kB", {.half_open_at = 100'000}},
      {"half-open", "every 10 kB", {.half_open_at = 10'000}},
      {"drop and cut", "50 %, 30 kB", {.drop = 0.5, .cut_at = 30'000}},
      {"drop and cut", "90 %, 30 kB", {.drop = 0.9, .cut_at = 30'000}},
      {"reorder and cut", "50 %, 30 kB", {.reorder = 0.5, .cut_at = 30'000}},
  };
}

/// What was reached on one level. Times are wall time; those of commands include all that were repeated.
struct Reached {
  Duration start{};
  Duration stop{};
  std::vector<Duration> answers;  ///< of status, in rising order
  int asked = 0;
  int refused = 0;  ///< first connections that failed
  std::string outcome;
  std::vector<std::string> problems;

  [[nodiscard]] double quantile_ms(double share) const {
    return answers.empty() ? -1.0 : 1e3 * to_seconds(quantile(answers, share));
  }
};

class LinkSweep : public ::testing::Test {
 protected:
  [[nodiscard]] rpc::ClientParams params(const std::string& name) {
    rpc::ClientParams p;
    p.client_name = name;
    p.on_link = [this, name](const rpc::LinkEvent& event) {
      links_.add(name + " " + std::string(rpc::to_string(event.state)) + ": " + event.why);
    };
    p.reconnect.first_delay = milliseconds(20);
    return p;
  }
  [[nodiscard]] std::unique_ptr<Follower> connect(Reached& reached, Ledger& ledger) {
    constexpr int kMostTries = 200;
    for (; reached.refused < kMostTries; ++reached.refused) {
      auto made = std::make_unique<Follower>(
          proxy_->port(), params("operator"), ledger, Ledger::kImpaired,
          std::vector<api::TopicRequest>{{api::Topic::kStatus, 5.0}, {api::Topic::kTiles, 2.0}});
      if (made->connected()) {
        return made;
      }
    }
    return nullptr;
  }
  /// Repeats the call until it is known to have been carried out; how long that took.
  template <class Call>
  static Duration until_done(Follower& follower, Call&& call) {
    const auto begin = std::chrono::steady_clock::now();
    constexpr int kMostTries = 300;
    for (int k = 0; k < kMostTries && follower.wait_connected() && !call(); ++k) {
    }
    return std::chrono::steady_clock::now() - begin;
  }
  [[nodiscard]] Duration start_mission(Follower& follower, const api::MissionId& id) {
    constexpr int kLongEnough = 20;
    return until_done(follower, [&] {
      const auto answer = follower.ask<api::MissionAccepted>(
          [&](auto reply) { follower.client().start_mission(to_and_fro(id, kLongEnough), std::move(reply)); });
      return answer || !unknown(answer.error());
    });
  }
  static void ask_status(Follower& follower, int times, Reached& reached) {
    for (int k = 0; k < times; ++k) {
      // Where there is no connection for so long, the call fails, and that is what was reached.
      static_cast<void>(follower.wait_connected());
      const auto begin = std::chrono::steady_clock::now();
      const auto answer =
          follower.ask<api::RobotStatus>([&](auto reply) { follower.client().get_status(std::move(reply)); });
      ++reached.asked;
      if (answer) {
        reached.answers.push_back(std::chrono::steady_clock::now() - begin);
      }
    }
    std::sort(reached.answers.begin(), reached.answers.end());
  }

  [[nodiscard]] Reached run(const Level& level, int times) {
    Reached reached;
    Ledger ledger;
    proxy_->impair({});
    links_.clear();
    Follower reference(robot_->port(), params("reference"), ledger, Ledger::kReference);
    EXPECT_TRUE(reference.connected() && reference.settle());
    proxy_->impair(level.impairment);
    const std::unique_ptr<Follower> impaired = connect(reached, ledger);
    if (!impaired || !impaired->settle()) {
      reached.outcome = "no connection";
      return reached;
    }
    ledger.begin();
    const api::MissionId id = "sweep-" + std::to_string(++missions_);
    reached.start = start_mission(*impaired, id);
    ask_status(*impaired, times, reached);
    reached.stop = until_done(*impaired, [&] {
      const auto answer = impaired->ask<void>([&](auto reply) { impaired->client().stop(std::move(reply)); });
      return answer || !unknown(answer.error());
    });
    EXPECT_TRUE(ledger.wait_ended(id));
    // What is on its way over a slow link arrives late, not never.
    proxy_->impair({});
    EXPECT_TRUE(ledger.wait_level());
    reached.problems = ledger.problems();
    reached.outcome = ledger.outcome(id);
    return reached;
  }

  log::ScopedSink quiet_{[](const log::Line&) {}};
  Recorder<std::string> links_;  ///< of the present level
  std::unique_ptr<LinkedRobot> robot_;
  std::unique_ptr<ChaosProxy> proxy_;
  int missions_ = 0;
};

constexpr const char* kHeader =
    "impairment,level,refused_connections,start_ms,asked,answered,status_p50_ms,status_p99_ms,stop_ms,outcome,"
    "reliable_items_wrong\n";

std::string row_of(const Level& level, const Reached& reached) {
  return fmt::format("{},{},{},{:.0f},{},{},{:.1f},{:.1f},{:.0f},{},{}\n", level.kind, level.level, reached.refused,
                     1e3 * to_seconds(reached.start), reached.asked, reached.answers.size(), reached.quantile_ms(0.50),
                     reached.quantile_ms(0.99), 1e3 * to_seconds(reached.stop), reached.outcome,
                     reached.problems.size());
}

TEST_F(LinkSweep, OverEveryKindOfLinkAMissionIsStartedFollowedAndStopped) {
  const char* file = std::getenv("SEEKER_SWEEP");
  const bool whole = file != nullptr;
  constexpr double kFasterThanLife = 20.0;
  robot_ = std::make_unique<LinkedRobot>(whole ? 1.0 : kFasterThanLife, fresh_folder("sweep"), on_port(0));
  proxy_ = std::make_unique<ChaosProxy>(robot_->port());
  std::vector<Level> all = levels();
  if (!whole) {
    all.erase(all.begin() + kFew, all.end());
  }
  std::string table = kHeader;
  for (const Level& level : all) {
    SCOPED_TRACE(std::string(level.kind) + " " + level.level);
    constexpr int kTimes = 40;
    constexpr int kFewTimes = 5;
    const Reached reached = run(level, whole ? kTimes : kFewTimes);
    const std::string row = row_of(level, reached);
    std::cout << row << std::flush;
    table += row;
    EXPECT_TRUE(reached.outcome == "OPERATOR" || reached.outcome == "LINK_LOST")
        << reached.outcome << "\n"
        << ::testing::PrintToString(links_.items());
    EXPECT_THAT(reached.problems, ::testing::IsEmpty());
    ASSERT_FALSE(reached.answers.empty());
    EXPECT_GE(reached.answers.front(), 2 * level.impairment.delay);
  }
  if (whole) {
    std::ofstream(file) << table;
  }
}

}  // namespace
}  // namespace seeker::testing
