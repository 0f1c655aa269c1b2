/// \file
/// A robot of real devices, which the emulator plays.
#pragma once

#include <fstream>

#include "tests/integration/processes/daemon.hpp"
#include "tests/integration/processes/truth.hpp"

namespace seeker::testing {

/// The emulator with one robot, whose base, laser scanner and camera are on lines of their own, in real time.
class EmulatedHardware {
 public:
  /// `laser` is a kind of device; `faults` are those of seeker-emulator.
  EmulatedHardware(const std::string& world, const std::string& laser, const std::vector<std::string>& faults = {},
                   const std::filesystem::path& folder = fresh_folder("hardware"))
      : base(folder / "base"), lidar(folder / "lidar"), truth(folder / "truth.csv") {
    const std::filesystem::path devices = folder / "devices";
    std::vector<std::string> arguments{"--world",        source_file("config/worlds/" + world + ".yaml"),
                                       "--config",       source_file("config/robots/live.yaml"),
                                       "--robots",       "1",
                                       "--set",          "sim.people=false",
                                       "--port",         "0",
                                       "--truth",        truth,
                                       "--device",       "p2os@" + base.string(),
                                       "--device",       laser + "@" + lidar.string(),
                                       "--device",       "camera@tcp://127.0.0.1:0",
                                       "--devices-file", devices};
    for (const std::string& fault : faults) {
      arguments.insert(arguments.end(), {"--fault", fault});
    }
    process.emplace(program("seeker-emulator"), arguments, folder / "log");
    EXPECT_TRUE(wait_for_file(devices, kStart)) << process->output();
    std::ifstream lines(devices);
    for (std::string name, address; lines >> name >> address;) {
      camera = name == "camera" ? address : camera;
    }
  }

  /// What seekerd is started with, besides the robot file.
  [[nodiscard]] std::vector<std::string> lines() const {
    return {"--set", "hardware.base.port=" + base.string(), "--set", "hardware.lidar.port=" + lidar.string(),
            "--set", "hardware.camera.device=" + camera,    "--set", "sensors.camera=true"};
  }

  /// What really happened so far.
  [[nodiscard]] std::vector<TruthRow> rows() const { return read_truth(truth); }
  /// The robot's contacts with obstacles so far.
  [[nodiscard]] int contacts() const {
    const std::vector<TruthRow> all = rows();
    EXPECT_FALSE(all.empty());
    return all.empty() ? -1 : all.back().contacts;
  }

  std::filesystem::path base;
  std::filesystem::path lidar;
  std::filesystem::path truth;
  std::string camera;
  std::optional<ChildProcess> process;
};

}  // namespace seeker::testing
