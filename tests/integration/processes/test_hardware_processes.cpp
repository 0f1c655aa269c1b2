// Robot files of real devices against the emulated ones, over pseudo-terminals in real time, with bit errors, and each
// device unplugged once. Bit errors come at 1e-6; both devices are away for three seconds each.

#include "tests/integration/processes/hardware.hpp"

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
  constexpr int kFault = 1;
  EXPECT_EQ(seeker(daemon, {"goto", "8,0", "--json", "-q"}, &output, kMission), kFault) << output;
  EXPECT_TRUE(contains(output, "\"outcome\":\"FAULT\"")) << output;
  EXPECT_EQ(hardware.contacts(), 0);
  return stop_of(hardware, kTrouble_s);
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
