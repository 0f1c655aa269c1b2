/// \file
/// Files of clients that arrive in pieces, and what becomes of them once they are whole. All disk work is done on a
/// worker, so that no tick waits for it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "common/api/robot_api.hpp"
#include "server/app/landmarks/landmark_service.hpp"
#include "server/app/robot/map_service.hpp"
#include "server/app/runtime/disk_worker.hpp"
#include "server/store/incoming_files.hpp"

namespace seeker::app {

/// Methods mean what they mean in api::RobotApi and may be called from any thread. Outlives neither of the services;
/// its end finishes what was accepted.
class TransferService {
 public:
  /// An empty `folder`: nothing can be sent to this robot.
  TransferService(std::filesystem::path folder, MapService& maps, LandmarkService& landmarks);

  void begin(const api::FileOffer& offer, const api::Reply<std::uint64_t>& reply);
  void append(const api::UploadPiece& piece, const api::Reply<std::uint64_t>& reply);
  void finish(const api::UploadEnd& end, const api::Reply<api::UploadedFile>& reply);
  void read(const api::FileRead& wish, const api::Reply<api::FilePiece>& reply);
  /// The request with the pictures that it names by their hash. kNotFound: one is not here; kInvalidArgument: the
  /// request is not valid with it.
  void add_pictures(const api::MissionRequest& request, const api::Reply<api::MissionRequest>& reply);

 private:
  template <class T>
  void on_worker(const api::Reply<T>& reply, std::function<Result<T>(store::IncomingFiles&)> work);
  [[nodiscard]] Status post(std::function<void(store::IncomingFiles&)> work);
  void hand_over(const std::filesystem::path& file, const api::UploadEnd& end,
                 const api::Reply<api::UploadedFile>& reply);

  std::filesystem::path folder_;
  MapService& maps_;
  LandmarkService& landmarks_;
  store::IncomingFiles files_;  ///< the worker's
  DiskWorker disk_;
};

}  // namespace seeker::app
