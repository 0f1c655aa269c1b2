/// \file
/// Sends a file to a robot or fetches one, in pieces, over cuts of the link and restarts of the robot.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/api/robot_api.hpp"

namespace seeker::rpc {

struct TransferParams {
  /// Most bytes of one call. After each cut half as many are tried, so that a slow link passes one within the time
  /// after which it counts as lost, and twice as many after each that arrived.
  std::size_t piece_bytes = std::size_t{256} << 10U;
  Duration stall_limit = std::chrono::seconds(30);  ///< wall time without a new byte, after which it gives up
  /// Why to stop at once, as Ctrl-C; std::nullopt: go on. Asked every 50 ms.
  std::function<std::optional<Error>()> broken = [] { return std::optional<Error>(); };
  /// Bytes of the file that have arrived, and its size.
  std::function<void(std::uint64_t, std::uint64_t)> on_progress = [](std::uint64_t, std::uint64_t) {};
};

/// One transfer at a time, on the thread of the caller, which must not be the one that delivers replies. Errors of all:
/// those of the robot; kLinkLost, kTimeout, kBusy when no byte has arrived for TransferParams::stall_limit; those of
/// TransferParams::broken. A call that fails can be repeated and goes on where it was.
class FileTransfer {
 public:
  /// At most so many bytes of the file from an offset on; none at its end.
  using Source = std::function<Result<std::vector<std::uint8_t>>(std::uint64_t, std::size_t)>;
  /// Keeps the bytes that belong at an offset.
  using Sink = std::function<Status(std::uint64_t, std::span<const std::uint8_t>)>;

  FileTransfer(std::shared_ptr<api::RobotApi> robot, TransferParams params);

  /// Sends what the robot does not have of the file. kUnsupportedVersion: it is too old to take pieces; kIo: the file
  /// became shorter meanwhile.
  [[nodiscard]] Status send(const api::FileOffer& offer, const Source& source);
  [[nodiscard]] Result<api::UploadedFile> finish(const api::UploadEnd& end);
  /// Hash and size of a file of the robot.
  [[nodiscard]] Result<api::FilePiece> look(api::FileKind kind, const std::string& name);
  /// Fetches the bytes from `from.offset` on of the file with the hash and size of `file`. kRefused: the robot's file
  /// has changed.
  [[nodiscard]] Status receive(api::FileRead from, const api::FilePiece& file, const Sink& sink);

 private:
  using Clock = std::chrono::steady_clock;

  /// Makes a call and waits for its answer.
  template <class T>
  [[nodiscard]] Result<T> once(const std::function<void(api::Reply<T>)>& call);
  /// Makes it again while the link is down or the robot is busy.
  template <class T>
  [[nodiscard]] Result<T> until_answered(const std::function<void(api::Reply<T>)>& call);
  [[nodiscard]] Result<std::uint64_t> begin(const api::FileOffer& offer);
  /// Waits a little before the next attempt after this error; the error where there is none.
  [[nodiscard]] Status pause_after(const Error& error);
  void arrived(std::uint64_t offset, std::uint64_t size_bytes);

  std::shared_ptr<api::RobotApi> robot_;
  TransferParams params_;
  std::size_t piece_bytes_;
  std::uint64_t furthest_ = 0;
  Clock::time_point progress_at_;  ///< when furthest_ has risen last
};

}  // namespace seeker::rpc
