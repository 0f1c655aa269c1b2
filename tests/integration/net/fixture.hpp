/// \file
/// A server on a free loopback port with a fake robot behind it, and raw sockets to torment it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>

#include "common/log/log.hpp"
#include "common/rpc/robot_client.hpp"
#include "common/rpc/wait.hpp"
#include "common/wire/envelope.hpp"
#include "seeker/v1/session.pb.h"
#include "server/net/server.hpp"
#include "tests/support/fake_robot.hpp"
#include "tests/support/net/await.hpp"
#include "tests/support/net/chaos_proxy.hpp"

namespace seeker::testing {

using std::chrono::milliseconds;
namespace pb = ::seeker::v1;

/// A client that does exactly what it is told. Blocking.
class RawClient {
 public:
  explicit RawClient(std::uint16_t port) : socket_(io_) {
    socket_.connect({boost::asio::ip::address_v4::loopback(), port});
  }
  void send_bytes(const std::string& bytes) {
    boost::system::error_code ignored;
    boost::asio::write(socket_, boost::asio::buffer(bytes), ignored);
  }
  /// False: the connection has ended.
  [[nodiscard]] bool send_byte(char byte) {
    boost::system::error_code error;
    boost::asio::write(socket_, boost::asio::buffer(&byte, 1), error);
    return !error;
  }
  void send(const pb::Envelope& envelope) {
    const auto frame = wire::frame_of(envelope);
    send_bytes(frame->head + *frame->body + frame->tail);
  }
  void hello(const std::string& name, std::uint32_t major = api::kProtocolMajor, std::uint32_t minor = 0) {
    pb::Envelope envelope;
    envelope.mutable_hello()->set_protocol_major(major);
    envelope.mutable_hello()->set_protocol_minor(minor);
    envelope.mutable_hello()->set_client_name(name);
    envelope.mutable_hello()->set_instance(std::hash<std::string>()(name));
    envelope.mutable_hello()->set_role(pb::ROLE_OPERATOR);
    send(envelope);
  }
  /// Nothing: the connection ended.
  std::optional<pb::Envelope> receive() {
    for (;;) {
      if (const auto payload = decoder_.next()) {
        auto envelope = wire::parse_envelope(*payload);
        return envelope ? std::optional<pb::Envelope>(std::move(*envelope)) : std::nullopt;
      }
      std::array<char, 4096> chunk{};
      boost::system::error_code error;
      const std::size_t n = socket_.read_some(boost::asio::buffer(chunk), error);
      if (error || !decoder_.feed(std::string_view(chunk.data(), n))) {
        return std::nullopt;
      }
    }
  }
  /// Reads on until a frame of the kind comes; nothing when the connection ends before.
  std::optional<pb::Envelope> receive(pb::Envelope::BodyCase kind) {
    for (;;) {
      auto envelope = receive();
      if (!envelope || envelope->body_case() == kind) {
        return envelope;
      }
    }
  }

 private:
  boost::asio::io_context io_;
  boost::asio::ip::tcp::socket socket_;
  wire::FrameDecoder decoder_;
};

class NetTest : public ::testing::Test {
 protected:
  NetTest() { params_.port = 0; }

  void start() {
    server_ = std::make_unique<server_net::Server>(robot_, params_);
    const auto port = server_->start();
    ASSERT_TRUE(port) << port.error().message;
    port_ = *port;
  }
  [[nodiscard]] rpc::ClientParams client_params(const std::string& name) {
    rpc::ClientParams p;
    p.client_name = name;
    p.connect_timeout = std::chrono::seconds(20);
    p.call_timeout = std::chrono::seconds(20);
    p.reconnect.first_delay = milliseconds(5);
    p.reconnect.max_delay = milliseconds(50);
    p.on_link = [this](const rpc::LinkEvent& event) { links_.add(event); };
    return p;
  }
  [[nodiscard]] std::shared_ptr<rpc::RobotClient> connect(const std::string& name, std::uint16_t port = 0) {
    auto client = rpc::RobotClient::connect({"127.0.0.1", port == 0 ? port_ : port}, client_params(name));
    EXPECT_TRUE(client) << client.error().message;
    return client ? *client : nullptr;
  }
  template <class T, class Call>
  [[nodiscard]] static Result<T> ask(Call&& call) {
    return rpc::wait<T>(std::forward<Call>(call), std::chrono::seconds(20));
  }
  [[nodiscard]] bool logged(const std::string& words) {
    return log_.wait([&](const std::vector<std::string>& lines) {
      return std::any_of(lines.begin(), lines.end(),
                         [&](const std::string& line) { return line.find(words) != std::string::npos; });
    });
  }
  void publish_event(const std::string& text) {
    api::Event event;
    event.kind = "test";
    event.text = text;
    robot_.publish(api::Topic::kEvent, robot_time_s(1.0), event);
  }

  Recorder<std::string> log_;
  log::ScopedSink quiet_{[this](const log::Line& line) { log_.add(line.text); }};
  Recorder<rpc::LinkEvent> links_;
  FakeRobotHost robot_;
  server_net::ServerParams params_;
  std::unique_ptr<server_net::Server> server_;
  std::uint16_t port_ = 0;
};

}  // namespace seeker::testing
