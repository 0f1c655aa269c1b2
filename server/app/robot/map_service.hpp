/// \file
/// The robot's maps on disk as clients see them. The loop hands over values; files are read and written on a worker,
/// so that no tick waits for a disk.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/api/robot_api.hpp"
#include "server/app/loop/robot_loop.hpp"
#include "server/app/runtime/disk_worker.hpp"
#include "server/app/runtime/mailbox.hpp"
#include "server/store/map_files.hpp"

namespace seeker::app {

/// Where maps are kept and what is written into them.
struct MapStorage {
  std::filesystem::path folder;  ///< empty: this robot keeps no maps
  std::string robot_id;
  std::string software_version;
};

/// Methods mean what they mean in api::RobotApi and may be called from any thread. Outlives neither loop nor mailbox;
/// its end finishes what was accepted.
class MapService {
 public:
  MapService(MapStorage storage, RobotLoop& loop, Mailbox& mailbox);

  void save(const std::string& name, bool replace, const api::Reply<api::MapSummary>& reply);
  void load(const std::string& name, api::MapUse use, const api::Reply<api::MapSummary>& reply);
  void list(const api::Reply<std::vector<api::MapSummary>>& reply);
  void inspect(const std::string& name, bool verify, const api::Reply<api::MapSummary>& reply);
  void remove(const std::string& name, const api::Reply<void>& reply);
  void download(const std::string& name, const api::Reply<std::vector<std::uint8_t>>& reply);
  void upload(const api::MapUpload& upload, const api::Reply<api::MapSummary>& reply);

  /// Goes on with a paused mission, or with one that a crash cut off: in the map it had built, where that was kept.
  void resume_mission(const std::string& client, const api::Reply<void>& reply);
  /// Keeps the map of a running mission; the loop gets the answer. From the loop's thread.
  void write_checkpoint(const api::MissionId& mission, Checkpoint checkpoint);
  /// Keeps where the robot is in it; the loop is told when that is done.
  void write_place(const api::MissionId& mission, const MissionPlace& place);
  /// Saves the map of a mission that did not go on in it under a name of its own.
  void set_checkpoint_aside(const api::MissionId& mission);
  void drop_checkpoints();

 private:
  using Work = std::function<void(const store::MapFiles&)>;

  /// Runs `work` on the worker; an error when there is no folder or too much waits.
  [[nodiscard]] Status enqueue(Work work);
  template <class T>
  void on_worker(const api::Reply<T>& reply, std::function<Result<T>(const store::MapFiles&)> work);
  void write(const LoopMap& from, const std::string& name, bool replace, const api::Reply<api::MapSummary>& reply);
  [[nodiscard]] store::MapFile file_of(const LoopMap& from, const std::string& name) const;
  void tell(const std::string& kind, const std::string& text, api::Severity severity);
  [[nodiscard]] std::filesystem::path checkpoint_folder() const {
    return storage_.folder / "checkpoints" / storage_.robot_id;
  }
  void resume_from(const api::MissionId& mission, const std::string& client, const api::Reply<void>& reply);

  MapStorage storage_;
  RobotLoop& loop_;
  Mailbox& mailbox_;
  store::MapFiles files_;
  store::MapFiles checkpoints_;  ///< of missions, by their ids; for the worker only
  DiskWorker disk_;
};

}  // namespace seeker::app
