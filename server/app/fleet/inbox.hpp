/// \file
/// A place for an answer that another thread gives later.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "common/api/robot_api.hpp"

namespace seeker::app {

/// Keeps the newest answer until it is taken. Any thread may call all of it, and a reply may be called after the inbox
/// is gone: the mutex that guards the answer is shared with the replies. Failures are dropped.
template <class T>
class Inbox {
 public:
  [[nodiscard]] api::Reply<T> reply() const {
    return [kept = kept_](Result<T> answer) {
      if (answer) {
        const std::lock_guard lock(kept->mutex);
        kept->answer = std::move(*answer);
      }
    };
  }
  /// Nothing where none has come since the last call.
  [[nodiscard]] std::optional<T> take() {
    const std::lock_guard lock(kept_->mutex);
    return std::exchange(kept_->answer, std::nullopt);
  }

 private:
  struct Kept {
    std::mutex mutex;
    std::optional<T> answer;
  };
  std::shared_ptr<Kept> kept_ = std::make_shared<Kept>();
};

}  // namespace seeker::app
