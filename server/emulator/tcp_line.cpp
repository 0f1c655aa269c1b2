#include "server/emulator/tcp_line.hpp"

#include <array>

#include <boost/asio/buffer.hpp>
#include <boost/asio/error.hpp>

namespace seeker::emulator {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

Status TcpLine::plug() {
  error_code error;
  const tcp::endpoint endpoint(asio::ip::make_address(host_, error), port_);
  if (!error) {
    acceptor_.open(endpoint.protocol(), error);
  }
  if (!error) {
    acceptor_.set_option(tcp::acceptor::reuse_address(true), error);
  }
  if (!error) {
    acceptor_.bind(endpoint, error);
  }
  if (!error) {
    acceptor_.listen(1, error);
  }
  if (!error) {
    acceptor_.non_blocking(true, error);
  }
  if (error) {
    return fail(Errc::kIo, "no device at " + address() + ": " + error.message() + "; choose another port");
  }
  port_ = acceptor_.local_endpoint().port();
  return {};
}

void TcpLine::unplug() {
  error_code ignored;
  host_socket_.close(ignored);
  acceptor_.close(ignored);
}

void TcpLine::admit() {
  error_code error;
  tcp::socket socket = acceptor_.accept(error);
  if (error || host_socket_.is_open()) {
    return;
  }
  host_socket_ = std::move(socket);
  host_socket_.non_blocking(true, error);
  host_socket_.set_option(tcp::no_delay(true), error);
}

std::vector<std::uint8_t> TcpLine::receive() {
  admit();
  std::array<std::uint8_t, 4096> chunk;
  error_code error;
  const std::size_t count = host_socket_.is_open() ? host_socket_.read_some(asio::buffer(chunk), error) : 0;
  if (error && error != asio::error::would_block) {
    host_socket_.close(error);
  }
  return {chunk.begin(), chunk.begin() + static_cast<std::ptrdiff_t>(count)};
}

void TcpLine::send(std::span<const std::uint8_t> bytes) {
  error_code error;
  if (host_socket_.is_open() && !bytes.empty()) {
    host_socket_.write_some(asio::buffer(bytes.data(), bytes.size()), error);
  }
}

}  // namespace seeker::emulator
