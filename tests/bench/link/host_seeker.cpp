// The robot of `./run bench link` behind Seeker's own server.
#include "server/net/server.hpp"
#include "tests/bench/link/host.hpp"
#include "tests/support/fake_robot.hpp"

namespace seeker::link_bench {
namespace {

server_net::ServerParams params_of(const HostOptions& options) {
  server_net::ServerParams params;
  params.port = 0;
  params.security.files = pki::bundle_in(options.bundle);
  params.robot_now = now;
  return params;
}

class SeekerHost final : public Host {
 public:
  SeekerHost(const HostOptions& options, Latencies& acts) : server_(robot_, params_of(options)) {
    robot_.edit([&acts](testing::FakeRobotValues& values) {
      values.on_drive = [&acts](const api::DriveCommand& command) {
        if (command.sent) {
          acts.add(now() - *command.sent);
        }
      };
    });
  }

  Status start() {
    const Result<std::uint16_t> port = server_.start();
    if (!port) {
      return tl::unexpected<Error>(port.error());
    }
    port_ = *port;
    return {};
  }
  [[nodiscard]] std::uint16_t port() const override { return port_; }
  void publish(api::Topic topic, RobotTime stamp, const api::Payload& payload) override {
    robot_.publish(topic, stamp, payload);
  }

 private:
  testing::FakeRobotHost robot_;
  server_net::Server server_;
  std::uint16_t port_ = 0;
};

Result<std::unique_ptr<Host>> make(const HostOptions& options, Latencies& acts) {
  auto host = std::make_unique<SeekerHost>(options, acts);
  if (const Status started = host->start(); !started) {
    return tl::unexpected<Error>(started.error());
  }
  return std::unique_ptr<Host>(std::move(host));
}

}  // namespace
}  // namespace seeker::link_bench

int main(int argc, char** argv) { return seeker::link_bench::run_host(argc, argv, seeker::link_bench::make); }
