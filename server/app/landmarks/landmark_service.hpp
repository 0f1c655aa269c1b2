/// \file
/// The robot's databases of landmarks as clients see them. Files are read and written on a worker.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/api/robot_api.hpp"
#include "server/app/landmarks/landmark_library.hpp"
#include "server/app/runtime/disk_worker.hpp"
#include "server/store/outgoing_files.hpp"

namespace seeker::app {

/// Methods mean what they mean in api::RobotApi and may be called from any thread; its end finishes what was accepted.
class LandmarkService {
 public:
  explicit LandmarkService(std::shared_ptr<LandmarkLibrary> library);

  void list(const api::Reply<std::vector<api::LandmarkSummary>>& reply);
  void inspect(const std::string& name, bool verify, const api::Reply<api::LandmarkSummary>& reply);
  void points(const std::string& name, const api::Reply<std::vector<api::LandmarkPoint>>& reply);
  void prune(const std::string& name, int min_views, const api::Reply<api::LandmarkSummary>& reply);
  void revert(const std::string& name, const api::Reply<api::LandmarkSummary>& reply);
  void remove(const std::string& name, const api::Reply<void>& reply);
  /// Keeps, or only checks, the database in `file`.
  void take(const std::filesystem::path& file, const api::UploadEnd& end,
            const api::Reply<api::LandmarkSummary>& reply);
  void read(const api::FileRead& wish, const api::Reply<api::FilePiece>& reply);

 private:
  template <class T>
  void on_worker(const api::Reply<T>& reply, std::function<Result<T>(LandmarkLibrary&)> work);
  /// On the worker, unless the robot's estimator goes by this database.
  void change(const std::string& name, const api::Reply<api::LandmarkSummary>& reply,
              std::function<Result<api::LandmarkSummary>(LandmarkLibrary&)> work);
  [[nodiscard]] Status may_change(const std::string& name) const;

  std::shared_ptr<LandmarkLibrary> library_;
  store::OutgoingFiles outgoing_;  ///< the worker's
  DiskWorker disk_;
};

}  // namespace seeker::app
