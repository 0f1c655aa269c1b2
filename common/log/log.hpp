/// \file
/// Logging outside the algorithms: one process-wide sink for lines of text, each with a level and the part that logs
/// it. The library behind it is an implementation detail (spdlog, in log.cpp only).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace seeker::log {

enum class Level : std::uint8_t { kDebug, kInfo, kWarning, kError, kOff };

/// One line; `part` is the folder or component that logs it, e.g. "server/net".
struct Line {
  Level level = Level::kInfo;
  std::string part;
  std::string text;
};

/// Called under a lock, one line at a time, on the thread that logs.
using Sink = std::function<void(const Line&)>;

/// Sets the level below which lines are dropped. Default: kInfo.
void set_level(Level level);
[[nodiscard]] Level level();
/// Reads "debug", "info", "warning", "error" or "off"; std::nullopt for any other text.
[[nodiscard]] std::optional<Level> parse_level(std::string_view text);

void debug(std::string_view part, std::string_view text);
void info(std::string_view part, std::string_view text);
void warning(std::string_view part, std::string_view text);
void error(std::string_view part, std::string_view text);

/// Replaces the sink while it lives (tests, the operator console); the former one comes back afterwards.
class ScopedSink {
 public:
  explicit ScopedSink(Sink sink);
  ScopedSink(const ScopedSink&) = delete;
  ScopedSink& operator=(const ScopedSink&) = delete;
  ~ScopedSink();

 private:
  Sink former_;
};

/// The text written to stderr for a line: "<N>part: text" with the priority of syslog when the service manager reads
/// our stderr (journald = $JOURNAL_STREAM is set), otherwise "hh:mm:ss.mmm LEVEL part: text" without the time.
[[nodiscard]] std::string format_line(const Line& line, bool journald);

}  // namespace seeker::log
