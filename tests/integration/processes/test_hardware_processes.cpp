// Robot files of real devices against the emulated ones, over pseudo-terminals in real time, with bit errors, and each
// device unplugged once. Bit errors come at 1e-6; both devices are away for three seconds each.

#include <csignal>

#include "tests/integration/processes/hardware.hpp"
#include "tests/support/service_manager.hpp"

namespace seeker::testing {
namespace {

constexpr seconds kMission{600};

std::filesystem::path robot_file(const std::string& name) { return source_file("config/robots/" + name + ".yaml"); }

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// A mission of a Pioneer whose devices are troubled, in real time.
struct TroubledMission {
  TroubledMission(const std::string& name, const std::string& laser, const std::string& robot,
                  const std::vector<std::string>& mission)
      : hardware("demo", laser,
                 {"0 p2os bit-errors 1e-6", "0 " + laser + " bit-errors 1e-6", "25 p2os unplug for 3",
                  "45 " + laser + " unplug for 3"},
                 fresh_folder(name + "_devices")),
        daemon(hardware.lines(), fresh_folder(name + "_daemon"), robot_file(robot)),
        client(program("seeker"), arguments(mission), fresh_folder(name + "_client") / "out") {}

  [[nodiscard]] std::vector<std::string> arguments(std::vector<std::string> mission) const {
    mission.insert(mission.end(), {"--json", "-q", "--robot", daemon.address()});
    return mission;
  }

  /// It ends like that, without a contact, and each device was lost and came back.
  void expect(const std::string& outcome) {
    EXPECT_EQ(client.wait(kMission), 0) << client.output() << daemon.process->output();
    EXPECT_TRUE(contains(client.output(), "\"outcome\":\"" + outcome + "\"")) << client.output();
    EXPECT_EQ(hardware.contacts(), 0);
    const std::string log = daemon.process->output();
    for (const std::string device : {"base", "lidar"}) {
      EXPECT_TRUE(contains(log, "fault " + device + "-lost: ")) << log;
      EXPECT_TRUE(contains(log, "fault " + device + "-lost is gone")) << log;
    }
  }

  EmulatedHardware hardware;
  Daemon daemon;
  ChildProcess client;
};

/// The western rooms, in which both devices are away before all is known.
constexpr const char* kWesternRooms = "-1.2,-1.4 4.1,-1.4 4.1,7.6 -1.2,7.6";

/// All at once: they wait for the clock most of the time. Without devices the simulated robot ends them just so.
TEST(HardwareProcesses, MissionsEndAsInTheSimulatorThroughBitErrorsAndUnpluggedDevices) {
  TroubledMission search("lms_search", "lms200", "pioneer3dx_lms200", {"search", "--target", "cross"});
  TroubledMission exploration("lms_explore", "lms200", "pioneer3dx_lms200", {"explore", "--bound", kWesternRooms});
  TroubledMission by_rplidar("rplidar_search", "rplidar-a2", "pioneer3dx_rplidar", {"search", "--target", "cross"});
  search.expect("TARGET_FOUND");
  by_rplidar.expect("TARGET_FOUND");
  exploration.expect("BOUND_REACHED");
}

TEST(HardwareProcesses, ComponentsShowWhatHasGoneOverEachLine) {
  const EmulatedHardware hardware("demo", "lms200");
  const Daemon daemon(hardware.lines(), fresh_folder("pioneer_components"), robot_file("pioneer3dx_lms200"));
  std::string output;
  const auto end = std::chrono::steady_clock::now() + seconds(60);
  while (!contains(output, "\"connects\":1") && std::chrono::steady_clock::now() < end) {
    EXPECT_EQ(seeker(daemon, {"components", "--json"}, &output), 0);
  }
  EXPECT_TRUE(contains(output, "\"type\":\"hardware\"")) << output;
  EXPECT_TRUE(contains(output, "\"connects\":1")) << output;
  EXPECT_TRUE(contains(output, "\"packets_bad\":0")) << output;
}

/// The robot drives, loses its only range sensor or its base, and stands; the truth is written every 5 ms.
struct Stop {
  double moved_m = 0.0;         ///< before the trouble
  double stands_after_s = 0.0;  ///< the trouble
};

Stop stop_of(const EmulatedHardware& hardware, double trouble_s) {
  constexpr double kStill_m_s = 0.005;
  Stop stop;
  std::optional<TruthRow> before;
  for (const TruthRow& row : hardware.rows()) {
    if (before && row.time_s <= trouble_s) {
      stop.moved_m += (row.p_world - before->p_world).norm();
    } else if (before && (row.p_world - before->p_world).norm() > kStill_m_s * (row.time_s - before->time_s)) {
      stop.stands_after_s = row.time_s - trouble_s;
    }
    before = row;
  }
  return stop;
}

/// Drives along the corridor until the robot has stood still for long.
Stop stop_for(const std::string& fault, const std::string& name) {
  constexpr double kTrouble_s = 14.0;
  const EmulatedHardware hardware("corridor", "lms200", {"14 " + fault}, fresh_folder(name));
  std::vector<std::string> lines = hardware.lines();
  lines.insert(lines.end(), {"--set", "sensors.sonar=false", "--set", "loop.mission.fault_grace_s=5"});
  const Daemon daemon(lines, fresh_folder(name + "_daemon"), robot_file("pioneer3dx_lms200"));
  std::string output;
  constexpr int kStuckFault = 1;
  EXPECT_EQ(seeker(daemon, {"goto", "8,0", "--json", "-q"}, &output, kMission), kStuckFault) << output;
  EXPECT_TRUE(contains(output, "\"outcome\":\"FAULT\"")) << output;
  EXPECT_EQ(hardware.contacts(), 0);
  return stop_of(hardware, kTrouble_s);
}

/// The last of what really happened, once `holds` does for all of it; nothing when that does not come about. The time
/// passes by waiting for reports of the robot's program to `systemd`, which are returned by `heard`.
template <class Predicate>
std::optional<TruthRow> when(const EmulatedHardware& hardware, const ServiceManager& systemd,
                             std::vector<std::string>& heard, Predicate holds) {
  const auto end = std::chrono::steady_clock::now() + kStart;
  while (std::chrono::steady_clock::now() < end) {
    if (const std::vector<TruthRow> rows = hardware.rows(); !rows.empty() && holds(rows)) {
      return rows.back();
    }
    if (std::optional<std::string> report = systemd.next(std::chrono::milliseconds(200))) {
      heard.push_back(std::move(*report));
    }
  }
  return std::nullopt;
}

/// From the first row within the last `span_s` to the last one.
double moved_m(const std::vector<TruthRow>& rows, double span_s) {
  const auto first = std::find_if(rows.begin(), rows.end(),
                                  [&](const TruthRow& row) { return row.time_s >= rows.back().time_s - span_s; });
  return (rows.back().p_world - first->p_world).norm();
}

/// A robot that has moved so far in so much time is on its way.
constexpr double kSpan_s = 1.0;
constexpr double kOnItsWay_m = 0.2;

TEST(HardwareProcesses, TheBaseStandsByItsOwnWatchdogWhenTheLoopIsStuckAndSystemdHearsNothing) {
  const ServiceManager systemd(seconds(1));
  const EmulatedHardware hardware("corridor", "lms200", {}, fresh_folder("stuck_loop"));
  const Daemon daemon(hardware.lines(), fresh_folder("stuck_loop_daemon"), robot_file("pioneer3dx_lms200"));
  EXPECT_EQ(seeker(daemon, {"goto", "8,0", "--detach"}), 0) << daemon.process->output();
  std::vector<std::string> heard;
  const auto drives =
      when(hardware, systemd, heard, [](const auto& rows) { return moved_m(rows, kSpan_s) > kOnItsWay_m; });
  ASSERT_TRUE(drives) << daemon.process->output();
  daemon.process->send(SIGSTOP);
  static_cast<void>(systemd.reports());  // what was sent before
  heard.clear();
  const double stuck_s = hardware.rows().back().time_s;
  const auto stands = when(hardware, systemd, heard, [&](const auto& rows) {
    constexpr double kStill_m = 0.001;
    return rows.back().time_s > stuck_s + kSpan_s && moved_m(rows, kSpan_s) < kStill_m;
  });
  ASSERT_TRUE(stands) << "its watchdog did not stop it";
  EXPECT_EQ(heard, std::vector<std::string>{}) << "a program that is stuck gives no sign of life";
  const Stop stop = stop_of(hardware, stuck_s);
  EXPECT_GT(stop.stands_after_s, 1.0) << "nobody but its watchdog can stop it";
  // The watchdog's 2 s, a resend period since the last command, and braking.
  EXPECT_LT(stop.stands_after_s, 2.0 + 0.25 + 0.5 / 0.3);
  EXPECT_EQ(hardware.contacts(), 0);
  daemon.process->send(SIGCONT);
}

TEST(HardwareProcesses, TheRobotStandsSoonAfterItsOnlyRangeSensorFellSilent) {
  const Stop stop = stop_for("lms200 silence", "silent_lidar");
  EXPECT_GT(stop.moved_m, 0.2) << "it was on its way";
  // Three scans of 0.19 s, half a second to command zero, and 0.5 m/s braked by 0.3 m/s^2.
  EXPECT_LT(stop.stands_after_s, 3 * 0.19 + 0.5 + 0.5 / 0.3);
}

TEST(HardwareProcesses, TheBaseStandsByItsOwnWatchdogWhenItsLineIsLost) {
  const Stop stop = stop_for("p2os unplug", "lost_base");
  EXPECT_GT(stop.moved_m, 0.2) << "it was on its way";
  EXPECT_GT(stop.stands_after_s, 1.5) << "nobody but its watchdog can stop it";
  // The watchdog's 2 s, a resend period since the last command, and braking.
  EXPECT_LT(stop.stands_after_s, 2.0 + 0.25 + 0.5 / 0.3);
}

}  // namespace
}  // namespace seeker::testing
