#include "server/app/loop/robot_components.hpp"

#include <string>
#include <utility>
#include <vector>

namespace seeker::app {
namespace {

constexpr const char* kOdometry = "OdometrySample";
constexpr const char* kScan = "LaserScan";
constexpr const char* kEchoes = "SonarScan";
constexpr const char* kPicture = "CameraFrame";
constexpr const char* kPictures = "StereoFrame";
constexpr const char* kPose = "PoseEstimate";
constexpr const char* kMap = "OccupancyMap";
constexpr const char* kSightings = "Recognition";
constexpr const char* kTask = "MissionTask";
constexpr const char* kVelocity = "Twist2";

Port in(const char* name, const char* type) { return {name, type, false}; }
Port out(const char* name, const char* type) { return {name, type, true}; }

std::optional<api::ComponentLink> link_of(const drivers::Driver& device) {
  const std::optional<drivers::LinkStatistics> counts = device.statistics();
  return counts ? std::optional(api::ComponentLink{counts->bytes_in, counts->bytes_out, counts->packets_in,
                                                   counts->packets_bad, counts->bytes_skipped, counts->connects})
                : std::nullopt;
}

void add_driver(Components& components, const std::string& name, const std::string& type, drivers::Driver* device,
                std::vector<Port> ports) {
  if (device != nullptr) {
    components.add(name, "driver", type,
                   {[device] { return device->activate(); }, [device] { device->deactivate(); },
                    [device] { return link_of(*device); }},
                   std::move(ports));
  }
}

void add_parts(Components& components, const LoopParts& parts) {
  components.add("pose", "estimator", parts.estimator_type, {},
                 {in("odometry", kOdometry), in("scan", kScan), in("pictures", kPictures), out("pose", kPose)});
  components.add("map", "map", "occupancy", {},
                 {in("pose", kPose), in("scan", kScan), in("echoes", kEchoes), out("map", kMap)});
  components.add("recogniser", "recogniser", parts.recogniser_type, {parts.activate_recogniser, nullptr, nullptr},
                 {in("picture", kPicture), out("sightings", kSightings)});
  components.add("mission", "behaviour", "executor", {}, {out("task", kTask)});
  components.add("planner", "planner", parts.planner_type, {},
                 {in("task", kTask), in("pose", kPose), in("map", kMap), in("scan", kScan), in("echoes", kEchoes),
                  in("sightings", kSightings), in("pictures", kPictures), out("velocity", kVelocity)});
  components.add("safety", "supervisor", "clearance", {},
                 {in("wanted", kVelocity), in("odometry", kOdometry), in("scan", kScan), in("echoes", kEchoes),
                  out("velocity", kVelocity)});
}

/// Connects where `there` is true.
void connect(Components& components, bool there, const std::string& output, const std::string& input) {
  if (there) {
    components.connect(output, input);
  }
}

void connect_sensors(Components& components, const Devices& devices, const Connections& wires) {
  const bool lidar = devices.lidar != nullptr;
  const bool sonar = devices.sonar != nullptr;
  const bool map_by_lidar = lidar && wires.map.ranges == RangeSensor::kLidar;
  connect(components, lidar && wires.pose.scan, "lidar.scan", "pose.scan");
  connect(components, map_by_lidar, "lidar.scan", "map.scan");
  connect(components, lidar && wires.planner.scan, "lidar.scan", "planner.scan");
  connect(components, lidar && wires.safety.scan, "lidar.scan", "safety.scan");
  connect(components, sonar && !map_by_lidar, "sonar.echoes", "map.echoes");
  connect(components, sonar && wires.planner.echoes, "sonar.echoes", "planner.echoes");
  connect(components, sonar && wires.safety.echoes, "sonar.echoes", "safety.echoes");
  connect(components, devices.camera != nullptr, "camera.picture", "recogniser.picture");
  connect(components, devices.stereo != nullptr && wires.pose.pictures, "stereo.pictures", "pose.pictures");
  connect(components, devices.stereo != nullptr, "stereo.pictures", "planner.pictures");
}

}  // namespace

void add_components(Components& components, const LoopParts& parts, const Devices& devices,
                    const Connections& connections) {
  const std::string& type = devices.type;
  add_driver(components, "base", type, devices.base.get(), {in("velocity", kVelocity), out("odometry", kOdometry)});
  add_driver(components, "lidar", type, devices.lidar.get(), {out("scan", kScan)});
  add_driver(components, "sonar", type, devices.sonar.get(), {out("echoes", kEchoes)});
  add_driver(components, "camera", type, devices.camera.get(), {out("picture", kPicture)});
  add_driver(components, "stereo", type, devices.stereo.get(), {out("pictures", kPictures)});
  add_parts(components, parts);
  connect_sensors(components, devices, connections);
  components.connect("base.odometry", "pose.odometry");
  components.connect("base.odometry", "safety.odometry");
  components.connect("pose.pose", "map.pose");
  components.connect("pose.pose", "planner.pose");
  components.connect("map.map", "planner.map");
  components.connect("recogniser.sightings", "planner.sightings");
  components.connect("mission.task", "planner.task");
  components.connect("planner.velocity", "safety.wanted");
  components.connect("safety.velocity", "base.velocity");
}

}  // namespace seeker::app
