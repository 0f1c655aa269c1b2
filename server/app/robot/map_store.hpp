/// \file
/// The folder in which a robot keeps its maps, and the worker that reads and writes it.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "common/core/result.hpp"
#include "server/app/maps/robot_map.hpp"
#include "server/app/runtime/disk_worker.hpp"
#include "server/store/map_files.hpp"

namespace seeker::app {

/// Where maps are kept and what is written into them.
struct MapStorage {
  std::filesystem::path folder;  ///< empty: this robot keeps no maps
  std::string robot_id;
  std::string software_version;
};

/// Owner of the folder and of the worker. Any thread.
class MapStore {
 public:
  using Work = std::function<void(const store::MapFiles&)>;

  explicit MapStore(MapStorage storage);

  /// Runs `work` on the worker, after what was given to it before. kNotReady without a folder; kBusy when too much
  /// waits.
  [[nodiscard]] Status post(Work work);
  /// Does what was accepted and takes nothing more: those whose work it is call this before they end.
  void finish() { disk_.finish(); }

  [[nodiscard]] bool has_folder() const { return !storage_.folder.empty(); }
  /// Where the robot's checkpoints of missions are.
  [[nodiscard]] std::filesystem::path checkpoint_folder() const;
  /// A map as it is written under `name`, stamped with the wall clock.
  [[nodiscard]] store::MapFile file_of(const LoopMap& from, const std::string& name) const;

 private:
  MapStorage storage_;
  store::MapFiles files_;
  DiskWorker disk_;
};

}  // namespace seeker::app
