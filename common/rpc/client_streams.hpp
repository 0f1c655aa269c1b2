/// \file
/// One subscription of a client: what was asked for, what was delivered, who gets it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "common/api/robot_api.hpp"
#include "seeker/v1/calls.pb.h"

namespace seeker::rpc {

/// Outlives connections. deliver() and request() run on the client's thread, cancel() on any.
class ClientStream {
 public:
  ClientStream(std::uint64_t id, const std::vector<api::TopicRequest>& topics, api::UpdateSink sink);

  [[nodiscard]] std::uint64_t id() const { return id_; }
  [[nodiscard]] bool wants(api::Topic topic) const;
  /// Asks for everything after what was delivered.
  [[nodiscard]] seeker::v1::SubscribeRequest request() const;
  /// The robot told where each topic begins.
  void on_subscribed(const seeker::v1::SubscribeResponse& response, std::uint64_t stream_id);
  /// The robot was started again: its revisions count anew.
  void forget_segments() { segments_revision_ = 0; }
  /// Hands the update on, unless it was delivered before.
  void deliver(const api::UpdatePtr& update);
  /// Afterwards the sink is not called any more. Waits for a call that is running, unless it is the caller's own.
  void cancel();
  /// Of the map as far as it was delivered; 0: nothing was.
  [[nodiscard]] std::uint64_t tiles_revision() const { return tiles_revision_; }
  /// As above, of the segments.
  [[nodiscard]] std::uint64_t segments_revision() const { return segments_revision_; }

 private:
  struct Topic {
    api::TopicRequest request;
    std::uint64_t position = 0;  ///< RELIABLE: sequence delivered last
    std::uint64_t run = 0;       ///< that the position belongs to; 0: not known
  };

  std::uint64_t id_;
  std::vector<Topic> topics_;
  std::uint64_t tiles_revision_ = 0;
  std::uint64_t segments_revision_ = 0;
  std::recursive_mutex delivery_;  ///< recursive: a sink may end its own subscription
  bool cancelled_ = false;
  api::UpdateSink sink_;
};

/// What RobotClient::subscribe refuses.
[[nodiscard]] Status validate_topics(const std::vector<api::TopicRequest>& topics);

}  // namespace seeker::rpc
