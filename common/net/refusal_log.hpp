/// \file
/// Lines of the log about refused connections, of which anybody can cause any number.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "common/log/log.hpp"
#include "common/wire/liveness.hpp"

namespace seeker::net {

/// At most one line per period, with the number of those that it stands for.
class RefusalLog {
 public:
  explicit RefusalLog(Duration period) : period_(period) {}

  /// Notes a refusal; the line to write now, if one is due.
  [[nodiscard]] std::optional<std::string> note(const std::string& why, wire::WallTime now) {
    ++count_;
    last_ = why;
    return take(now);
  }
  /// The line about those that have waited, if one is due. To be called once per period.
  [[nodiscard]] std::optional<std::string> take(wire::WallTime now) {
    if (count_ == 0 || (written_at_ && now - *written_at_ < period_)) {
      return std::nullopt;
    }
    std::string line = count_ == 1 ? "a connection was refused: " + last_
                                   : std::to_string(count_) + " connections were refused, the last: " + last_;
    count_ = 0;
    written_at_ = now;
    return line;
  }

 private:
  Duration period_;
  std::size_t count_ = 0;
  std::string last_;
  std::optional<wire::WallTime> written_at_;
};

/// Writes what note() or take() gave, where it is a line. `part` names the component.
inline void write_refusals(std::string_view part, const std::optional<std::string>& line) {
  if (line) {
    log::warning(part, *line);
  }
}

}  // namespace seeker::net
