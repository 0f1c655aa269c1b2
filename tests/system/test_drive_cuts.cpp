// A robot that is driven by hand over a link that is cut at any moment. SEEKER_CUTS says how often (default 50).

#include <algorithm>
#include <cmath>

#include "common/core/rng.hpp"
#include "tests/support/environment.hpp"
#include "tests/system/live_devices.hpp"
#include "tests/system/simulated_robot.hpp"

namespace seeker::testing {
namespace {

/// Promised in docs/protocol.md.
constexpr Duration kZeroWithin = std::chrono::milliseconds(450);
constexpr Duration kTick = std::chrono::milliseconds(100);

int cuts() { return number_from_environment("SEEKER_CUTS", 50); }

/// A command that is on its way.
struct Packet {
  RobotTime arrives;
  api::DriveCommand command;
};

class DriveCuts : public ::testing::Test {
 protected:
  static constexpr std::uint64_t kSeed = 42;

  DriveCuts()
      : robot({"sim.speed=0", "sim.people=false", "sim.world=" + source_file("config/worlds/demo.yaml").string()},
              "config/robots/sim.yaml", [this](app::Devices& devices) {
                devices.clock = std::make_shared<LiveClock>(devices.clock);
                devices.base = base = std::make_shared<WatchedBase>(devices.base);
              }) {}

  [[nodiscard]] RobotTime now() const { return robot.loop->now(); }
  [[nodiscard]] Duration random_s(double from, double to) { return seconds(rng.uniform(from, to)); }
  Result<api::LeaseState> acquire(const std::string& client) {
    return robot.loop->commands().command_lease({client}, {api::LeaseAction::kAcquire, false}, robot.wall);
  }

  /// Sends one command at `at`. One of ten is late, by up to 5 s.
  void send(RobotTime at, const Twist2& velocity) {
    const bool late = rng.uniform(0.0, 1.0) < 0.1;
    const Duration on_its_way = late ? random_s(0.3, 5.0) : random_s(0.005, 0.12);
    const Duration clock_error = random_s(-0.02, 0.02);
    on_the_way.push_back({at + on_its_way,
                          {.velocity = velocity,
                           .ttl = std::chrono::milliseconds(300),
                           .lease_epoch = epoch,
                           .sequence = ++sequence,
                           .sent = at + clock_error}});
  }
  /// The robot takes what has arrived, then makes its tick.
  void tick() {
    for (auto packet = on_the_way.begin(); packet != on_the_way.end();) {
      if (packet->arrives > now()) {
        ++packet;
        continue;
      }
      taken += robot.loop->commands().drive("driver", packet->command) ? 1 : 0;
      packet = on_the_way.erase(packet);
    }
    robot.tick();
  }
  /// Drives about until `end`, ahead and on the spot: behind the robot there is no laser to stop it.
  void drive_until(RobotTime end) {
    Twist2 velocity;
    RobotTime turn = now();
    for (RobotTime at = now() + random_s(0.0, 0.1); at < end; at += kTick) {
      if (at >= turn) {
        velocity = {rng.uniform(0.0, 0.5), rng.uniform(-1.2, 1.2)};
        turn = at + random_s(0.5, 2.0);
      }
      send(at, velocity);
      while (now() + kTick <= at) {
        tick();
      }
    }
    while (now() < end) {
      tick();
    }
  }
  /// The longest that braking from this velocity takes.
  [[nodiscard]] Duration braking(const Twist2& v) const {
    const sim::RobotModel model;
    return seconds(std::max(std::abs(v.v_m_s) / model.acceleration_m_s2,
                            std::abs(v.omega_rad_s) / model.angular_acceleration_rad_s2));
  }
  [[nodiscard]] Twist2 velocity() const { return robot.simulation->truth().velocity; }
  [[nodiscard]] static bool stands(const Twist2& v) {
    return std::abs(v.v_m_s) < 1e-3 && std::abs(v.omega_rad_s) < 1e-3;
  }

  /// One cut at a random moment, and what comes of it.
  void cut() {
    const Result<api::LeaseState> lease = acquire("driver");
    ASSERT_TRUE(lease) << lease.error().message;
    epoch = lease->epoch;
    sequence = 0;
    const RobotTime cut_at = now() + random_s(0.5, 3.0);
    drive_until(cut_at);
    moved += stands(velocity()) ? 0 : 1;
    // Some of what is on its way never arrives.
    std::erase_if(on_the_way, [&](const Packet&) { return rng.uniform(0.0, 1.0) < 0.2; });
    expect_stand(cut_at);
    silence(cut_at);
    robot.loop->commands().client_back("driver");
  }
  void expect_stand(RobotTime cut_at) {
    while (now() <= cut_at + kZeroWithin + kTick) {
      tick();
    }
    EXPECT_EQ(base->commanded(), Twist2{});
    EXPECT_LE(base->zero_since() - cut_at, kZeroWithin);
  }
  /// The robot notices the silence, somebody else may take the lease, and what was late arrives.
  void silence(RobotTime cut_at) {
    const auto at = [&](double s) { return cut_at + seconds(s); };
    const bool taken_by_another = rng.uniform(0.0, 1.0) < 0.5;
    bool silent = false;
    bool lost = false;
    const Twist2 fastest{0.5, 1.2};
    const int taken_before = taken;
    while (now() < at(6.0)) {
      if (!silent && now() >= at(1.5)) {
        silent = true;
        robot.loop->commands().client_silent("driver", robot.wall - std::chrono::milliseconds(1500));
        if (taken_by_another) {
          EXPECT_TRUE(acquire("another"));
        }
      }
      if (!lost && now() >= at(3.0)) {
        lost = true;
        robot.loop->commands().client_lost("driver", "silent", robot.wall);
      }
      tick();
      EXPECT_EQ(base->commanded(), Twist2{}) << "a late packet moves it";
      if (now() >= base->zero_since() + braking(fastest) + 2 * kTick) {
        EXPECT_TRUE(stands(velocity())) << velocity().v_m_s << " " << velocity().omega_rad_s;
      }
    }
    EXPECT_EQ(taken, taken_before) << "a late packet is taken";
    on_the_way.clear();
    robot.loop->commands().client_closed("another");
  }

  std::shared_ptr<WatchedBase> base;
  SimulatedRobot robot;
  Rng rng{kSeed};
  std::vector<Packet> on_the_way;
  std::uint64_t epoch = 0;
  std::uint64_t sequence = 0;
  int taken = 0;  ///< commands that the robot has taken
  int moved = 0;  ///< cuts that met it while it moved
};

TEST_F(DriveCuts, TheRobotStandsWheneverTheLinkIsCut) {
  RecordProperty("seed", static_cast<int>(kSeed));
  for (int k = 0; k < cuts() && !HasFailure(); ++k) {
    SCOPED_TRACE("cut " + std::to_string(k) + ", seed " + std::to_string(kSeed));
    cut();
  }
  EXPECT_EQ(robot.simulation->truth().contacts, 0);
  EXPECT_GT(moved, cuts() / 2) << "most cuts must meet a robot that moves";
  EXPECT_GT(taken, 5 * cuts());
}

}  // namespace
}  // namespace seeker::testing
