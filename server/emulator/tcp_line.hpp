/// \file
/// A device behind a TCP port, as Pioneer bases have with a serial server.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>

#include "server/emulator/device_line.hpp"

namespace seeker::emulator {

/// One host at a time; a second one is sent away.
class TcpLine final : public DeviceLine {
 public:
  /// Port 0: any free one, which is kept while the device is unplugged.
  TcpLine(std::string host, std::uint16_t port) : host_(std::move(host)), port_(port) {}

  [[nodiscard]] Status plug() override;
  void unplug() override;
  [[nodiscard]] std::vector<std::uint8_t> receive() override;
  void send(std::span<const std::uint8_t> bytes) override;
  [[nodiscard]] std::uint32_t host_baud() const override { return 0; }
  [[nodiscard]] std::string address() const override { return "tcp://" + host_ + ":" + std::to_string(port_); }

 private:
  void admit();

  std::string host_;
  std::uint16_t port_;
  boost::asio::io_context io_{1};
  boost::asio::ip::tcp::acceptor acceptor_{io_};
  boost::asio::ip::tcp::socket host_socket_{io_};
};

}  // namespace seeker::emulator
