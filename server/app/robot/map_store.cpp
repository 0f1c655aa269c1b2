#include "server/app/robot/map_store.hpp"

#include <utility>

namespace seeker::app {
namespace {

/// Waiting requests; each may hold a whole map.
constexpr std::size_t kMaxWaiting = 16;

/// What the scans say about who made them.
std::string sensors_of(const LineMap& map) {
  if (map.keyframes.empty()) {
    return "no kept scans";
  }
  const MapKeyframe& scan = map.keyframes.front();
  constexpr double kTenth = 10.0;
  const int range_dm = static_cast<int>(static_cast<double>(scan.range_max_m) * kTenth);
  return "lidar with " + std::to_string(scan.ranges.size()) + " beams of up to " + std::to_string(range_dm / 10) + "." +
         std::to_string(range_dm % 10) + " m";
}

}  // namespace

MapStore::MapStore(MapStorage storage)
    : storage_(std::move(storage)), files_(storage_.folder), disk_(kMaxWaiting, "maps") {}

Status MapStore::post(Work work) {
  if (!has_folder()) {
    return fail(Errc::kNotReady, "this robot has no folder to keep maps in; start it with --state FOLDER");
  }
  return disk_.post([this, work = std::move(work)] { work(files_); });
}

std::filesystem::path MapStore::checkpoint_folder() const {
  return storage_.folder / "checkpoints" / storage_.robot_id;
}

store::MapFile MapStore::file_of(const LoopMap& from, const std::string& name) const {
  store::MapFile file;
  file.map = from.map;
  file.origin.name = name;
  file.origin.robot_id = storage_.robot_id;
  file.origin.software_version = storage_.software_version;
  file.origin.sensors = sensors_of(from.map);
  file.origin.saved_unix_s = wall_unix_s();
  file.origin.created_unix_s =
      from.identity.created_unix_s != 0 ? from.identity.created_unix_s : file.origin.saved_unix_s;
  return file;
}

}  // namespace seeker::app
