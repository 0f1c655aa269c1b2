/// \file
/// The robot's maps on disk as clients see them. The loop hands over values; files are read and written on a worker,
/// so that no tick waits for a disk.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/api/robot_api.hpp"
#include "server/app/loop/robot_loop.hpp"
#include "server/app/robot/map_store.hpp"
#include "server/app/runtime/mailbox.hpp"
#include "server/store/map_files.hpp"
#include "server/store/outgoing_files.hpp"

namespace seeker::app {

/// Methods mean what they mean in api::RobotApi and may be called from any thread. Outlives neither store, loop nor
/// mailbox; its end finishes what was accepted.
class MapService {
 public:
  MapService(MapStore& store, RobotLoop& loop, Mailbox& mailbox);
  MapService(const MapService&) = delete;
  MapService& operator=(const MapService&) = delete;
  ~MapService();

  void save(const std::string& name, bool replace, const api::Reply<api::MapSummary>& reply);
  void load(const std::string& name, api::MapUse use, const api::Reply<api::MapSummary>& reply);
  void list(const api::Reply<std::vector<api::MapSummary>>& reply);
  void inspect(const std::string& name, bool verify, const api::Reply<api::MapSummary>& reply);
  void remove(const std::string& name, const api::Reply<void>& reply);
  void download(const std::string& name, const api::Reply<std::vector<std::uint8_t>>& reply);
  void upload(const api::MapUpload& upload, const api::Reply<api::MapSummary>& reply);
  /// Keeps, or only checks, the map in `file`, which is read on the worker.
  void take(const std::filesystem::path& file, const api::UploadEnd& end, const api::Reply<api::MapSummary>& reply);
  void read(const api::FileRead& wish, const api::Reply<api::FilePiece>& reply);

 private:
  template <class T>
  void on_worker(const api::Reply<T>& reply, std::function<Result<T>(const store::MapFiles&)> work);
  /// Keeps the bytes that `fetch` gives on the worker.
  void keep(const std::string& name, bool replace, bool check_only,
            const std::function<Result<std::vector<std::uint8_t>>()>& fetch, const api::Reply<api::MapSummary>& reply);
  void write(const store::MapFiles& files, const LoopMap& from, const std::string& name, bool replace,
             const api::Reply<api::MapSummary>& reply);

  MapStore& store_;
  RobotLoop& loop_;
  Mailbox& mailbox_;
  store::OutgoingFiles outgoing_;  ///< the worker's
};

}  // namespace seeker::app
