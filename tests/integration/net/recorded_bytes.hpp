/// \file
/// What a client sends, for those who send it again.
#pragma once

#include <array>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/write.hpp>

#include "common/rpc/robot_client.hpp"
#include "tests/support/net/await.hpp"

namespace seeker::testing {

/// Passes bytes on and keeps those of the client.
inline std::string recorded_client_bytes(std::uint16_t port, const pki::BundleFiles& bundle) {
  boost::asio::io_context io;
  boost::asio::ip::tcp::acceptor acceptor(io, {boost::asio::ip::address_v4::loopback(), 0});
  const std::uint16_t relay_port = acceptor.local_endpoint().port();
  std::string sent;
  std::thread relay([&] {
    boost::asio::ip::tcp::socket client = acceptor.accept();
    boost::asio::ip::tcp::socket server(io);
    server.connect({boost::asio::ip::address_v4::loopback(), port});
    std::thread back([&] {
      std::array<char, 4096> bytes{};
      boost::system::error_code error;
      while (!error) {
        const std::size_t n = server.read_some(boost::asio::buffer(bytes), error);
        boost::system::error_code ignored;
        boost::asio::write(client, boost::asio::buffer(bytes, n), ignored);
      }
    });
    std::array<char, 4096> bytes{};
    boost::system::error_code error;
    while (!error) {
      const std::size_t n = client.read_some(boost::asio::buffer(bytes), error);
      sent.append(bytes.data(), n);
      boost::system::error_code ignored;
      boost::asio::write(server, boost::asio::buffer(bytes, n), ignored);
    }
    boost::system::error_code ignored;
    server.shutdown(boost::asio::ip::tcp::socket::shutdown_both, ignored);
    back.join();
  });
  rpc::ClientParams p;
  p.client_name = "tester";
  p.tls = bundle;
  p.connect_timeout = kPatience;
  {
    const auto client = rpc::RobotClient::connect({"127.0.0.1", relay_port}, p);
    EXPECT_TRUE(client) << client.error().message;
  }
  relay.join();
  return sent;
}

}  // namespace seeker::testing
