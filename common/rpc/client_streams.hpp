/// \file
/// One subscription of a client: the requested topics, the delivered items, and the sink.
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
  /// Request for all items after the delivered ones.
  [[nodiscard]] seeker::v1::SubscribeRequest request() const;
  /// Takes over the response of the robot, which states where each topic begins.
  void on_subscribed(const seeker::v1::SubscribeResponse& response, std::uint64_t stream_id);
  /// To be called when the robot was started again: its revisions begin at zero.
  void forget_segments() { segments_revision_ = 0; }
  /// Hands the update to the sink, unless it was delivered before.
  void deliver(const api::UpdatePtr& update);
  /// Ends the calls of the sink. Waits for a call that is running, unless it is made from that call.
  void cancel();
  /// Revision up to which tiles were delivered; 0: none were.
  [[nodiscard]] std::uint64_t tiles_revision() const { return tiles_revision_; }
  /// Revision up to which segments were delivered; 0: none were.
  [[nodiscard]] std::uint64_t segments_revision() const { return segments_revision_; }

 private:
  struct Topic {
    api::TopicRequest request;
    std::uint64_t position = 0;  ///< RELIABLE: sequence of the last delivered item
    std::uint64_t run = 0;       ///< run of the robot that the position belongs to; 0: not known
  };

  std::uint64_t id_;
  std::vector<Topic> topics_;
  std::uint64_t tiles_revision_ = 0;
  std::uint64_t segments_revision_ = 0;
  std::recursive_mutex delivery_;  ///< recursive: a sink may end its own subscription
  bool cancelled_ = false;
  api::UpdateSink sink_;
};

/// Checks the topics of a subscription, as RobotClient::subscribe() does.
[[nodiscard]] Status validate_topics(const std::vector<api::TopicRequest>& topics);

}  // namespace seeker::rpc
