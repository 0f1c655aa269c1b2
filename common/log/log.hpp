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

/// How lines are written to stderr.
enum class Format : std::uint8_t {
  kText,      ///< "hh:mm:ss.mmm LEVEL part: text"
  kJournald,  ///< "<N>part: text" with the priority of syslog, for a service manager that reads our stderr
  kJson,      ///< {"time":"2026-11-28T16:49:24.123456Z","level":"INFO","part":"net","text":"up"}, for other programs
};

/// Sets the form of lines from now on. Default: kJournald where the service manager reads our stderr ($JOURNAL_STREAM
/// is set), otherwise kText.
void set_format(Format format);
/// Reads "text", "journald" or "json"; std::nullopt for any other text.
[[nodiscard]] std::optional<Format> parse_format(std::string_view text);

/// The line as it is written, without its time and what encloses it in JSON. It holds no line break.
[[nodiscard]] std::string format_line(const Line& line, Format format);

}  // namespace seeker::log
