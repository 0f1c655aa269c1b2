/// \file
/// Reads a slow device on its own thread, so that callers get the newest pictures at once.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "common/core/image.hpp"
#include "common/core/result.hpp"
#include "common/core/time.hpp"

namespace seeker::drivers {

/// A source of successive pictures, used by one thread.
class PictureSource {
 public:
  PictureSource() = default;
  PictureSource(const PictureSource&) = delete;
  PictureSource& operator=(const PictureSource&) = delete;
  virtual ~PictureSource() = default;

  [[nodiscard]] virtual Status open() = 0;
  /// Waits for the next picture. A failure ends the source until it is opened again.
  [[nodiscard]] virtual Result<Image> read() = 0;
  virtual void close() = 0;
  /// Whether a source that failed may give pictures again when it is opened again: a device or a network does, a file
  /// that has ended does not.
  [[nodiscard]] virtual bool comes_back() const { return false; }
};

/// Robot time of the present.
using NowFunction = std::function<RobotTime()>;

struct PictureReaderParams {
  Duration max_age = std::chrono::milliseconds(500);         ///< older pictures are not returned
  Duration first_picture = std::chrono::milliseconds(5000);  ///< time to open the device and to set its exposure
  Duration reopen_after = std::chrono::milliseconds(1000);   ///< a source that failed is opened again so much later
  std::size_t kept = 4;  ///< number of newest pictures kept, to find those of one moment
};

class PictureReader {
 public:
  /// `name` appears in error messages.
  PictureReader(std::string name, std::unique_ptr<PictureSource> source, NowFunction now,
                const PictureReaderParams& params);
  PictureReader(const PictureReader&) = delete;
  PictureReader& operator=(const PictureReader&) = delete;
  ~PictureReader();

  /// Starts opening and reading the device; errors are reported by pictures().
  void start();
  /// Waits for the thread to end, which may be in a call of the device.
  void stop();

  /// The newest pictures, oldest first, none older than max_age; never empty. kNotReady: there is none yet, try again.
  /// kTimeout: no picture for too long. Otherwise the error of the source.
  [[nodiscard]] Result<std::deque<CameraFrame>> pictures() const;
  /// Waits until a picture has come or the source has failed, for people and tests. False: neither happened within the
  /// limit.
  [[nodiscard]] bool wait_for_picture(std::chrono::milliseconds limit) const;

 private:
  void run();
  void read_until_it_fails();
  /// False: the reader is to stop.
  [[nodiscard]] bool wait_to_reopen();

  std::string name_;
  std::unique_ptr<PictureSource> source_;
  NowFunction now_;
  PictureReaderParams params_;
  std::thread thread_;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  // Guarded by mutex_:
  std::deque<CameraFrame> frames_;
  std::optional<Error> error_;
  RobotTime started_;
  bool running_ = false;
  bool stopping_ = false;
};

}  // namespace seeker::drivers
