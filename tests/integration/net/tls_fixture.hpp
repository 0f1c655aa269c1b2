/// \file
/// A server that speaks TLS with certificates of its own site, and clients of OpenSSL that do what they are told.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include <gmock/gmock.h>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/ssl/stream.hpp>

#include "tests/integration/net/fixture.hpp"
#include "tests/support/net/site.hpp"

namespace seeker::testing {

namespace ssl = boost::asio::ssl;

/// Shakes hands as TLS versions from `lowest` to `highest`, with a certificate or without. Blocking.
class TlsPeer {
 public:
  TlsPeer(std::uint16_t port, const std::optional<pki::BundleFiles>& shows, int lowest = TLS1_3_VERSION,
          int highest = TLS1_3_VERSION)
      : context_(ssl::context::tls_client) {
    SSL_CTX_set_min_proto_version(context_.native_handle(), lowest);
    SSL_CTX_set_max_proto_version(context_.native_handle(), highest);
    if (shows) {
      context_.use_certificate_file(shows->certificate.string(), ssl::context::pem);
      context_.use_private_key_file(shows->key.string(), ssl::context::pem);
    }
    stream_ = std::make_unique<ssl::stream<boost::asio::ip::tcp::socket>>(io_, context_);
    stream_->next_layer().connect({boost::asio::ip::address_v4::loopback(), port});
    stream_->handshake(ssl::stream_base::client, handshake_);
  }
  /// Empty: it succeeded on this side.
  [[nodiscard]] const boost::system::error_code& handshake() const { return handshake_; }
  /// Why nothing comes; waits for the server's word.
  [[nodiscard]] std::string end() {
    std::array<char, 64> bytes{};
    boost::system::error_code error;
    while (!error) {
      stream_->read_some(boost::asio::buffer(bytes), error);
    }
    return error.message();
  }
  [[nodiscard]] ssl::stream<boost::asio::ip::tcp::socket>& stream() { return *stream_; }

 private:
  boost::asio::io_context io_;
  ssl::context context_;
  std::unique_ptr<ssl::stream<boost::asio::ip::tcp::socket>> stream_;
  boost::system::error_code handshake_;
};

/// Files are looked at often, and nobody is shut out unless a test wants it.
class TlsTest : public NetTest {
 protected:
  TlsTest() {
    params_.security.files = robot_files_;
    params_.security.check_period = milliseconds(20);
    params_.security.lockout.loopback = false;
    params_.heartbeat = milliseconds(100);
    params_.lost_after = std::chrono::seconds(20);
    params_.on_link_faults = [this](const std::vector<api::Fault>& faults) { faults_.add(faults); };
  }
  [[nodiscard]] Result<std::shared_ptr<rpc::RobotClient>> try_connect(const std::optional<pki::BundleFiles>& tls,
                                                                      const std::string& host = "127.0.0.1") {
    rpc::ClientParams p = client_params("tester");
    p.tls = tls;
    return rpc::RobotClient::connect({host, port_}, p);
  }
  [[nodiscard]] std::shared_ptr<rpc::RobotClient> connect_as(const pki::BundleFiles& tls) {
    auto client = try_connect(tls);
    EXPECT_TRUE(client) << client.error().message;
    return client ? *client : nullptr;
  }
  void expect_unharmed() {
    const auto client = connect_as(site_.issue("good", pki::Role::kOperator));
    ASSERT_TRUE(client);
    EXPECT_TRUE(ask<api::RobotStatus>([&](auto r) { client->get_status(r); }));
  }
  TestSite site_;
  pki::BundleFiles robot_files_ = site_.robot();
  Recorder<std::vector<api::Fault>> faults_;
};

}  // namespace seeker::testing
