#include <algorithm>
#include <map>

#include <nlohmann/json.hpp>

#include "client/cli/update_queue.hpp"
#include "client/cli/verbs.hpp"
#include "client/values/names.hpp"
#include "client/values/values.hpp"
#include "client/values/values_json.hpp"

namespace seeker::cli {
namespace {

std::vector<api::TopicRequest> topics_of(const WatchVerb& verb) {
  const std::vector<std::string> names =
      verb.topics.empty() ? std::vector<std::string>{"status", "mission", "event", "detection"} : verb.topics;
  std::vector<api::TopicRequest> topics;
  for (const api::Topic topic : all_topics()) {
    if (std::find(names.begin(), names.end(), to_string(topic)) != names.end()) {
      topics.push_back({topic, verb.rate_hz, 0});
    }
  }
  return topics;
}

/// Prints one line per change; on a terminal what changes all the time stays on one line at the bottom.
class LiveView {
 public:
  explicit LiveView(const Context& context) : context_(context), live_(context.out_is_tty && !context.json) {}
  LiveView(const LiveView&) = delete;
  LiveView& operator=(const LiveView&) = delete;
  ~LiveView() {
    if (live_ && !bottom_.empty()) {
      *context_.out << '\n' << std::flush;
    }
  }

  void show(const api::Update& update) {
    if (context_.json) {
      *context_.out << json_line(Json(update)) << '\n' << std::flush;
      return;
    }
    const std::string line = text_of(update);
    // The time stamp in front always differs.
    constexpr std::size_t kStampLength = 13;
    const std::string content = line.substr(std::min(line.size(), kStampLength));
    std::string& former = shown_[update.topic];
    if (stream_class(update.topic) == api::StreamClass::kLatest && former == content) {
      return;
    }
    former = content;
    if (!live_) {
      *context_.out << line << '\n' << std::flush;
    } else if (stream_class(update.topic) == api::StreamClass::kLatest) {
      constexpr std::size_t kColumns = 118;
      bottom_ = line.substr(0, kColumns);
      *context_.out << "\r\x1b[K" << bottom_ << std::flush;
    } else {
      *context_.out << "\r\x1b[K" << line << '\n' << bottom_ << std::flush;
    }
  }

 private:
  const Context& context_;
  bool live_;
  std::string bottom_;
  std::map<api::Topic, std::string> shown_;
};

}  // namespace

VerbResult watch(const Context& context, const WatchVerb& verb) {
  const Result<Stream> stream = open_stream(*context.robot, topics_of(verb));
  if (!stream) {
    return tl::unexpected<Error>(stream.error());
  }
  const auto start = std::chrono::steady_clock::now();
  LiveView view(context);
  for (;;) {
    if (const auto update = stream->queue->pop(kPollPeriod)) {
      view.show(**update);
    }
    if (context.interrupted() || !context.out->good()) {
      return ExitCode::kOk;  // this is how one leaves it
    }
    if (const std::optional<Error> error = context.link_error()) {
      return tl::unexpected<Error>(*error);
    }
    if (context.timeout && std::chrono::steady_clock::now() - start >= *context.timeout) {
      return ExitCode::kOk;
    }
  }
}

}  // namespace seeker::cli
