#include "common/log/log.hpp"

#include <atomic>
#include <cstdlib>
#include <mutex>
#include <utility>

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <nlohmann/json.hpp>

namespace seeker::log {
namespace {

/// Priorities of syslog, as the service manager understands them at the start of a line.
int priority(Level level) {
  switch (level) {
    case Level::kError: return 3;
    case Level::kWarning: return 4;
    case Level::kInfo: return 6;
    default: return 7;
  }
}

std::string_view name(Level level) {
  switch (level) {
    case Level::kError: return "ERROR";
    case Level::kWarning: return "WARNING";
    case Level::kInfo: return "INFO";
    default: return "DEBUG";
  }
}

void write_to_stderr(const Line& line);

/// Who reads our stderr, unless somebody says so.
Format usual_format() { return std::getenv("JOURNAL_STREAM") != nullptr ? Format::kJournald : Format::kText; }

struct State {
  std::mutex mutex;
  Sink sink = write_to_stderr;
  Format format = usual_format();
  std::atomic<Level> level{Level::kInfo};
};

/// Never destroyed: threads may log while the program ends.
State& state() {
  static auto* const instance = new State;
  return *instance;
}

/// spdlog writes whole lines under its lock and adds the time where nobody else does.
void set_pattern(spdlog::logger& logger, Format format) {
  switch (format) {
    case Format::kText: return logger.set_pattern("%H:%M:%S.%e %v");
    case Format::kJournald: return logger.set_pattern("%v");
    case Format::kJson:
      return logger.set_pattern(R"({"time":"%Y-%m-%dT%H:%M:%S.%fZ",%v})", spdlog::pattern_time_type::utc);
  }
}

/// Called under the lock of the state.
void write_to_stderr(const Line& line) {
  static const std::shared_ptr<spdlog::logger> logger = [] {
    auto made = std::make_shared<spdlog::logger>("seeker", std::make_shared<spdlog::sinks::stderr_sink_mt>());
    made->set_level(spdlog::level::trace);
    made->flush_on(spdlog::level::trace);
    return made;
  }();
  static std::optional<Format> written;
  if (written != state().format) {
    written = state().format;
    set_pattern(*logger, *written);
  }
  logger->info("{}", format_line(line, *written));
}

std::string json_fields(const Line& line) {
  const nlohmann::ordered_json fields{{"level", name(line.level)}, {"part", line.part}, {"text", line.text}};
  // What a peer has said may be no UTF-8.
  const std::string object = fields.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return object.substr(1, object.size() - 2);
}

void write(Level level, std::string_view part, std::string_view text) {
  State& now = state();
  if (level < now.level.load(std::memory_order_relaxed)) {
    return;
  }
  const Line line{level, std::string(part), std::string(text)};
  const std::lock_guard lock(now.mutex);
  now.sink(line);
}

Sink exchange_sink(Sink sink) {
  const std::lock_guard lock(state().mutex);
  return std::exchange(state().sink, std::move(sink));
}

}  // namespace

void set_level(Level level) { state().level.store(level, std::memory_order_relaxed); }
Level level() { return state().level.load(std::memory_order_relaxed); }

std::optional<Level> parse_level(std::string_view text) {
  if (text == "debug") {
    return Level::kDebug;
  }
  if (text == "info") {
    return Level::kInfo;
  }
  if (text == "warning") {
    return Level::kWarning;
  }
  if (text == "error") {
    return Level::kError;
  }
  return text == "off" ? std::optional(Level::kOff) : std::nullopt;
}

void debug(std::string_view part, std::string_view text) { write(Level::kDebug, part, text); }
void info(std::string_view part, std::string_view text) { write(Level::kInfo, part, text); }
void warning(std::string_view part, std::string_view text) { write(Level::kWarning, part, text); }
void error(std::string_view part, std::string_view text) { write(Level::kError, part, text); }

ScopedSink::ScopedSink(Sink sink) : former_(exchange_sink(std::move(sink))) {}
ScopedSink::~ScopedSink() { exchange_sink(std::move(former_)); }

void set_format(Format format) {
  const std::lock_guard lock(state().mutex);
  state().format = format;
}

std::optional<Format> parse_format(std::string_view text) {
  if (text == "text") {
    return Format::kText;
  }
  if (text == "journald") {
    return Format::kJournald;
  }
  return text == "json" ? std::optional(Format::kJson) : std::nullopt;
}

std::string format_line(const Line& line, Format format) {
  if (format == Format::kJson) {
    return json_fields(line);
  }
  std::string text = format == Format::kJournald ? "<" + std::to_string(priority(line.level)) + ">"
                                                 : std::string(name(line.level)) + " ";
  text += line.part;
  text += ": ";
  // One line a record: a newline from a peer must not forge a second one.
  for (const char c : line.text) {
    text += c == '\n' || c == '\r' ? ' ' : c;
  }
  return text;
}

}  // namespace seeker::log
