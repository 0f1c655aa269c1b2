#include <array>
#include <cctype>
#include <mutex>

#include <unistd.h>

#include "client/cli/program.hpp"
#include "client/cli/tls_bundle.hpp"
#include "common/log/log.hpp"
#include "common/rpc/endpoint.hpp"
#include "common/rpc/robot_client.hpp"

namespace seeker::cli {
namespace {

using SteadyClock = std::chrono::steady_clock;

/// A long verb gives up when no connection could be made for this long.
constexpr Duration kGiveUpAfter = std::chrono::seconds(30);
/// With two, one stop in some hundreds is held back by a network that loses 5 % of the packets; nothing is lost within
/// a machine.
constexpr int kStopLinks = 2;

/// Program, host and process: unique, and the same over reconnects.
std::string client_name() {
  std::array<char, 65> host{};
  if (::gethostname(host.data(), host.size() - 1) != 0) {
    host = {'h', 'o', 's', 't'};
  }
  std::string name = "seeker-";
  for (const char* c = host.data(); *c != '\0'; ++c) {
    name += std::isalnum(static_cast<unsigned char>(*c)) != 0 ? *c : '-';
  }
  return name + "-" + std::to_string(::getpid());
}

/// Written by the client's thread, read by that of the verb.
class LinkWatch {
 public:
  void note(const rpc::LinkEvent& event) {
    const std::lock_guard lock(mutex_);
    if (state_ == rpc::LinkState::kConnected && event.state != rpc::LinkState::kConnected) {
      since_ = SteadyClock::now();
    }
    state_ = event.state;
    why_ = event.why;
    if (event.state == rpc::LinkState::kLost) {
      log::warning("client", "link lost: " + event.why);
    } else if (event.robot_restarted) {
      log::warning("client", "the robot was restarted");
    }
  }
  [[nodiscard]] std::optional<Error> error() const {
    const std::lock_guard lock(mutex_);
    const bool closed = state_ == rpc::LinkState::kClosed;
    const bool too_long = state_ != rpc::LinkState::kConnected && SteadyClock::now() - since_ > kGiveUpAfter;
    if (closed || too_long) {
      return Error{Errc::kLinkLost, "the link to the robot is gone: " + why_};
    }
    return std::nullopt;
  }

 private:
  mutable std::mutex mutex_;
  rpc::LinkState state_ = rpc::LinkState::kConnected;
  std::string why_;
  SteadyClock::time_point since_;
};

}  // namespace

Result<Connection> connect_robot(const ConnectRequest& request) {
  const Result<rpc::Endpoint> endpoint = rpc::parse_endpoint(request.robot);
  if (!endpoint) {
    return fail_with_context("--robot", endpoint.error());
  }
  auto watch = std::make_shared<LinkWatch>();
  rpc::ClientParams params;
  params.client_name = request.client_name.empty() ? client_name() : request.client_name;
  Result<std::optional<pki::BundleFiles>> tls = bundle_for(request.tls, endpoint->host);
  if (!tls) {
    return tl::unexpected<Error>(tls.error());
  }
  params.tls = std::move(*tls);
  params.reconnect.enabled = request.reconnect;
  params.stop_links = request.stops && !rpc::is_this_machine(endpoint->host) ? kStopLinks : 0;
  params.on_link = [watch](const rpc::LinkEvent& event) { watch->note(event); };
  if (request.timeout) {
    params.connect_timeout = *request.timeout;
    params.call_timeout = *request.timeout;
  }
  const auto robot = rpc::RobotClient::connect(*endpoint, params);
  if (!robot) {
    return tl::unexpected<Error>(robot.error());
  }
  return Connection{*robot, (*robot)->client_name(), [watch] { return watch->error(); }, (*robot)->role(),
                    [client = *robot](const api::Reply<rpc::TimeSync>& reply) { client->sync_time(reply); }};
}

}  // namespace seeker::cli
