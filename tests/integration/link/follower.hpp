/// \file
/// A client whose RELIABLE items are noted in a ledger.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "common/rpc/robot_client.hpp"
#include "common/rpc/wait.hpp"
#include "tests/integration/link/ledger.hpp"

namespace seeker::testing {

class Follower {
 public:
  /// `latest`: topics that are followed besides. Where the first connection fails there is no client.
  Follower(std::uint16_t port, const rpc::ClientParams& params, Ledger& ledger, Ledger::Side side,
           std::vector<api::TopicRequest> latest = {}) {
    Result<std::shared_ptr<rpc::RobotClient>> client = rpc::RobotClient::connect({"127.0.0.1", port}, params);
    if (!client) {
      return;
    }
    client_ = std::move(*client);
    for (const api::Topic topic :
         {api::Topic::kMission, api::Topic::kEvent, api::Topic::kDetection, api::Topic::kSegments}) {
      latest.push_back({topic});
    }
    auto made =
        client_->subscribe(latest, [&ledger, side](const api::UpdatePtr& update) { ledger.note(side, update); });
    EXPECT_TRUE(made) << made.error().message;
    subscription_ = std::move(*made);
  }
  Follower(const Follower&) = delete;
  Follower& operator=(const Follower&) = delete;
  ~Follower() {
    subscription_.reset();
    if (client_) {
      client_->close();
    }
  }

  [[nodiscard]] bool connected() const { return client_ != nullptr; }
  [[nodiscard]] rpc::RobotClient& client() { return *client_; }
  /// A call without a connection is answered at once: whoever repeats one waits for that first.
  [[nodiscard]] bool wait_connected() {
    return eventually([&] { return client_->link() != rpc::LinkState::kLost; });
  }
  template <class T, class Call>
  [[nodiscard]] Result<T> ask(Call&& call) {
    return rpc::wait<T>(std::forward<Call>(call), kPatience);
  }
  /// Answered after the subscription: from here on nothing may be missing. Asks until there is an answer.
  [[nodiscard]] bool settle() {
    return eventually(
        [&] { return ask<api::RobotInfo>([&](auto reply) { client_->get_info(std::move(reply)); }).has_value(); });
  }

 private:
  std::shared_ptr<rpc::RobotClient> client_;
  std::unique_ptr<api::Subscription> subscription_;
};

/// Whether the call may have been carried out.
inline bool unknown(const Error& error) { return error.code == Errc::kLinkLost || error.code == Errc::kTimeout; }

}  // namespace seeker::testing
