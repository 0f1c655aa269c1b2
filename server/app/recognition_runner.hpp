/// \file
/// Runs a recogniser on one picture at a time: inline in lockstep, on a worker thread when live.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "server/app/behaviour.hpp"

namespace seeker::app {

/// A picture with everything that was true when it was taken.
struct RecognitionJob {
  std::shared_ptr<const vision::Recogniser> recogniser;
  Image image;
  Recognition context;  ///< its sightings are filled in
};

class RecognitionRunner {
 public:
  explicit RecognitionRunner(bool inline_mode);
  RecognitionRunner(const RecognitionRunner&) = delete;
  RecognitionRunner& operator=(const RecognitionRunner&) = delete;
  ~RecognitionRunner();

  /// True while a picture is being looked at or its answer waits.
  [[nodiscard]] bool busy() const;
  /// Starts one; the runner must not be busy.
  void start(RecognitionJob job);
  /// The answer, once it is there.
  [[nodiscard]] std::optional<Result<Recognition>> take();

 private:
  void work();

  const bool inline_mode_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  bool quit_ = false;
  std::optional<RecognitionJob> job_;
  bool working_ = false;
  std::optional<Result<Recognition>> answer_;
  std::thread worker_;
};

}  // namespace seeker::app
