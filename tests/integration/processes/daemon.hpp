/// \file
/// Server and client as processes of their own.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/pki/bundle.hpp"
#include "common/rpc/robot_client.hpp"
#include "tests/support/data.hpp"
#include "tests/support/process.hpp"

namespace seeker::testing {

using std::chrono::seconds;

inline constexpr seconds kStart{60};
inline constexpr seconds kCall{20};

/// seekerd on a free port with a state folder of its own.
class Daemon {
 public:
  explicit Daemon(std::vector<std::string> extra = {}, std::filesystem::path folder = fresh_folder("daemon"),
                  const std::filesystem::path& config = source_file("config/robots/sim.yaml"))
      : folder_(std::move(folder)) {
    const std::filesystem::path port_file = folder_ / "port";
    std::filesystem::remove(port_file);
    std::vector<std::string> arguments{"--config",    config,    "--port",  "0",
                                       "--port-file", port_file, "--state", folder_ / "state"};
    arguments.insert(arguments.end(), extra.begin(), extra.end());
    process.emplace(program("seekerd"), arguments, fresh_log());
    const std::optional<std::string> text = wait_for_file(port_file, kStart);
    port = text ? *text : "";
    EXPECT_TRUE(text) << process->output();
  }

  [[nodiscard]] std::string address() const { return "127.0.0.1:" + port; }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// As a crash would end it: it can tidy nothing.
  void kill() { process->kill(); }

  std::optional<ChildProcess> process;
  std::string port;

 private:
  /// A program that is started again leaves what the one before wrote.
  [[nodiscard]] std::filesystem::path fresh_log() const {
    std::filesystem::path log = folder_ / "log";
    for (int again = 1; std::filesystem::exists(log); ++again) {
      log = folder_ / ("log-" + std::to_string(again));
    }
    return log;
  }

  std::filesystem::path folder_;
};

/// What seekerd is started with so that it shows this certificate and asks its clients for theirs.
inline std::vector<std::string> tls_settings(const pki::BundleFiles& robot) {
  return {"--set", "server.tls.certificate=" + robot.certificate.string(),
          "--set", "server.tls.key=" + robot.key.string(),
          "--set", "server.tls.ca=" + robot.ca.string(),
          "--set", "server.tls.revocations=" + robot.revocations.string()};
}

/// One call of the command line; its exit code.
inline int seeker(const Daemon& daemon, std::vector<std::string> arguments, std::string* output = nullptr,
                  seconds limit = seconds(300)) {
  arguments.insert(arguments.end(), {"--robot", daemon.address()});
  ChildProcess client(program("seeker"), arguments, fresh_folder("client") / "out");
  const std::optional<int> code = client.wait(limit);
  if (output != nullptr) {
    *output = client.output();
  }
  EXPECT_TRUE(code) << "the client did not end: " << client.output();
  return code.value_or(-1);
}

inline std::shared_ptr<rpc::RobotClient> connect(const Daemon& daemon, const std::string& name) {
  const Result<rpc::Endpoint> endpoint = rpc::parse_endpoint(daemon.address());
  rpc::ClientParams params;
  params.client_name = name;
  Result<std::shared_ptr<rpc::RobotClient>> client = rpc::RobotClient::connect(endpoint.value(), params);
  EXPECT_TRUE(client) << client.error().message;
  return client.value();
}

}  // namespace seeker::testing
