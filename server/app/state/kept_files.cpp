#include "server/app/state/kept_files.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "common/wire/convert.hpp"
#include "common/wire/convert_fleet.hpp"
#include "common/wire/fleet_fields.hpp"
#include "seeker/v1/kept.pb.h"
#include "server/app/state/kept_message.hpp"

namespace seeker::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPlaceKind = "place";
constexpr const char* kTopologyKind = "topology";
constexpr const char* kSearchKind = "search";
constexpr std::array kKinds{kPlaceKind, kTopologyKind, kSearchKind};
/// A topology or a search within its limits takes less.
constexpr std::size_t kMaxFileBytes = 4UL << 20U;
/// The message is that of a fleet, which wants a name.
constexpr const char* kOwner = "self";

fs::path path_of(const fs::path& folder, const api::MissionId& mission, const std::string& kind) {
  return folder / (mission + "." + kind);
}

Result<MissionPlace> read_place(const fs::path& path) {
  const auto message = read_kept_message<v1::KeptPlace>(path, kPlaceKind, kMaxFileBytes);
  if (!message) {
    return tl::unexpected<Error>(message.error());
  }
  const Result<Pose2> map_T_base = wire::from_message<Pose2>(message->map_t_base());
  const Result<Point2> start_map = wire::from_message<Point2>(message->start_map());
  if (!map_T_base || !start_map) {
    return tl::unexpected<Error>(!map_T_base ? map_T_base.error() : start_map.error());
  }
  MissionPlace place{*map_T_base, {}};
  if (message->has_start_map()) {
    place.so_far.start_map = *start_map;
  }
  place.so_far.running = std::max(Duration(message->running_ns()), Duration::zero());
  wire::Check check;
  wire::read_detections(message->found(), place.so_far.found, check);
  if (!check.ok()) {
    return tl::unexpected<Error>(check.status().error());
  }
  return place;
}

/// Nothing where it belongs to another state of the map.
Result<std::optional<TopologyMemory>> read_topology(const fs::path& path, std::uint32_t map_epoch) {
  const auto message = read_kept_message<v1::KeptTopology>(path, kTopologyKind, kMaxFileBytes);
  if (!message) {
    return tl::unexpected<Error>(message.error());
  }
  if (message->map_epoch() != map_epoch) {
    return std::optional<TopologyMemory>();
  }
  Result<RobotTopology> told = wire::from_message<RobotTopology>(message->topology());
  Result<std::vector<Point2>> closed = wire::from_message<std::vector<Point2>>(message->closed_map());
  Result<std::vector<Point2>> looked_at = wire::from_message<std::vector<Point2>>(message->looked_at_map());
  if (!told || !closed || !looked_at) {
    return tl::unexpected<Error>(!told ? told.error() : !closed ? closed.error() : looked_at.error());
  }
  return std::optional<TopologyMemory>({std::move(told->topology), std::move(*closed), std::move(*looked_at)});
}

/// Nothing where it belongs to another state of the map.
Result<std::optional<SearchMemory>> read_search(const fs::path& path, std::uint32_t map_epoch) {
  const auto message = read_kept_message<v1::KeptSearch>(path, kSearchKind, kMaxFileBytes);
  if (!message) {
    return tl::unexpected<Error>(message.error());
  }
  if (message->map_epoch() != map_epoch) {
    return std::optional<SearchMemory>();
  }
  const Result<SearchedFloor> looks = wire::from_message<SearchedFloor>(message->looks());
  Result<api::GridLists> lists = wire::from_message<api::GridLists>(message->lists());
  if (!looks || !lists) {
    return tl::unexpected<Error>(!looks ? looks.error() : lists.error());
  }
  return std::optional<SearchMemory>({*looks->probability, std::move(*lists)});
}

void write_topology(const TopologyMemory& memory, v1::KeptTopology& message) {
  RobotTopology told;
  told.robot_id = kOwner;
  told.topology = memory.topology;
  wire::write(api::within_limits(std::move(told)), message.mutable_topology());
  wire::write(memory.closed_map, message.mutable_closed_map());
  wire::write(memory.looked_at_map, message.mutable_looked_at_map());
}

/// "Not found" is no trouble: nothing was kept.
void note(const Error& error, std::string& trouble) {
  if (error.code != Errc::kNotFound) {
    trouble += (trouble.empty() ? "" : "; ") + error.message;
  }
}

}  // namespace

Status keep_place(const fs::path& folder, const api::MissionId& mission, const MissionPlace& place) {
  v1::KeptPlace message;
  wire::write(place.map_T_base, message.mutable_map_t_base());
  if (place.so_far.start_map) {
    wire::write(*place.so_far.start_map, message.mutable_start_map());
  }
  message.set_running_ns(place.so_far.running.count());
  wire::write_detections(api::within_limits(place.so_far.found), message.mutable_found());
  // Every second: one that waited for a busy disk would be of a place the robot has left long ago.
  return store::write_sealed_file(path_of(folder, mission, kPlaceKind), kPlaceKind, message.SerializeAsString(),
                                  files::Outlives::kItsProgram);
}

Status keep_memory(const fs::path& folder, const api::MissionId& mission, const MissionMemory& memory,
                   std::uint32_t map_epoch) {
  const auto write = [&](const char* kind, const google::protobuf::MessageLite& message) {
    return store::write_sealed_file(path_of(folder, mission, kind), kind, message.SerializeAsString());
  };
  Status kept;
  if (memory.topology) {
    v1::KeptTopology message;
    message.set_map_epoch(map_epoch);
    write_topology(*memory.topology, message);
    kept = write(kTopologyKind, message);
  }
  if (kept && memory.search) {
    v1::KeptSearch message;
    message.set_map_epoch(map_epoch);
    const SearchedFloor looks{{}, {}, std::make_shared<const Grid<std::uint8_t>>(memory.search->looks)};
    wire::write(looks, message.mutable_looks());
    wire::write(memory.search->lists, message.mutable_lists());
    kept = write(kSearchKind, message);
  }
  return kept;
}

KeptState read_kept(const fs::path& folder, const api::MissionId& mission, std::uint32_t map_epoch,
                    std::string& trouble) {
  const auto found = [&trouble](auto&& read) {
    if (!read) {
      note(read.error(), trouble);
    }
    return std::forward<decltype(read)>(read);
  };
  KeptState kept;
  if (const auto place = found(read_place(path_of(folder, mission, kPlaceKind)))) {
    kept.map_T_base = place->map_T_base;
    kept.so_far = place->so_far;
  }
  if (auto topology = found(read_topology(path_of(folder, mission, kTopologyKind), map_epoch))) {
    kept.memory.topology = std::move(*topology);
  }
  if (auto search = found(read_search(path_of(folder, mission, kSearchKind), map_epoch))) {
    kept.memory.search = std::move(*search);
  }
  return kept;
}

void drop_kept(const fs::path& folder) {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const std::string ending = entry.path().extension().string();
    const bool ours =
        std::any_of(kKinds.begin(), kKinds.end(), [&](const char* kind) { return ending == std::string(".") + kind; });
    if (ours) {
      fs::remove(entry.path(), error);
    }
  }
}

}  // namespace seeker::app
