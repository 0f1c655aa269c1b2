#include "server/emulator/mjpeg_port.hpp"

#include <array>
#include <string_view>
#include <utility>

#include <boost/asio/buffer.hpp>
#include <boost/asio/error.hpp>

#include "common/image/jpeg.hpp"

namespace seeker::emulator {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

constexpr std::size_t kMostClients = 8;
constexpr std::size_t kLongestRequest = 8192;
constexpr std::string_view kAnswer =
    "HTTP/1.1 200 OK\r\nCache-Control: no-cache\r\nConnection: close\r\n"
    "Content-Type: multipart/x-mixed-replace; boundary=frame\r\n\r\n";

constexpr std::string_view kPath = "/camera.mjpg ";
constexpr std::string_view kNoSuchPath = "HTTP/1.1 404 Not Found\r\nContent-Length: 0\r\nConnection: close\r\n\r\n";
constexpr std::string_view kNoSuchMethod =
    "HTTP/1.1 405 Method Not Allowed\r\nAllow: GET, HEAD\r\nContent-Length: 0\r\nConnection: close\r\n\r\n";

void append(std::vector<std::uint8_t>& to, std::string_view text) { to.insert(to.end(), text.begin(), text.end()); }

}  // namespace

MjpegPort::MjpegPort(MjpegParams params, std::function<Image()> take_picture)
    : params_(std::move(params)), take_picture_(std::move(take_picture)) {}

Status MjpegPort::plug() {
  error_code error;
  const tcp::endpoint endpoint(asio::ip::make_address(params_.host, error), params_.port);
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
    acceptor_.listen(static_cast<int>(kMostClients), error);
  }
  if (!error) {
    acceptor_.non_blocking(true, error);
  }
  if (error) {
    return fail(Errc::kIo, "no camera at " + address() + ": " + error.message() + "; choose another port");
  }
  params_.port = acceptor_.local_endpoint().port();
  return {};
}

void MjpegPort::unplug() {
  error_code ignored;
  clients_.clear();
  acceptor_.close(ignored);
}

std::string MjpegPort::address() const {
  return "http://" + params_.host + ":" + std::to_string(params_.port) + "/camera.mjpg";
}

void MjpegPort::admit() {
  error_code error;
  tcp::socket socket = acceptor_.accept(error);
  if (error || clients_.size() >= kMostClients) {
    return;
  }
  socket.non_blocking(true, error);
  clients_.push_back({std::move(socket), {}, false, false, {}});
}

bool MjpegPort::receive(Client& client) {
  std::array<char, 1024> chunk;
  error_code error;
  const std::size_t count = client.socket.read_some(asio::buffer(chunk), error);
  if (error) {
    return error == asio::error::would_block;
  }
  if (!client.asked) {
    client.request.append(chunk.data(), count);
    client.asked = client.request.find("\r\n\r\n") != std::string::npos;
    if (client.asked) {
      answer(client);
    }
  }
  return client.asked || client.request.size() <= kLongestRequest;
}

void MjpegPort::answer(Client& client) {
  const std::string_view line = std::string_view(client.request).substr(0, client.request.find("\r\n"));
  const bool get = line.starts_with("GET ");
  const bool head = line.starts_with("HEAD ");
  const bool there = line.find(kPath) == line.find(' ') + 1;
  client.ends = !get || !there;
  append(client.to_go, !get && !head ? kNoSuchMethod : there ? kAnswer : kNoSuchPath);
}

bool MjpegPort::send(Client& client) {
  if (client.to_go.empty()) {
    return !client.ends;
  }
  error_code error;
  const std::size_t sent = client.socket.write_some(asio::buffer(client.to_go), error);
  if (error) {
    return error == asio::error::would_block;
  }
  client.to_go.erase(client.to_go.begin(), client.to_go.begin() + static_cast<std::ptrdiff_t>(sent));
  return true;
}

void MjpegPort::show(RobotTime now) {
  std::vector<std::uint8_t> part;
  for (Client& client : clients_) {
    if (!client.asked || client.ends || !client.to_go.empty()) {
      continue;
    }
    if (part.empty()) {
      const std::vector<std::uint8_t> picture = image::encode_jpeg(take_picture_(), params_.quality);
      append(part,
             "--frame\r\nContent-Type: image/jpeg\r\nContent-Length: " + std::to_string(picture.size()) + "\r\n\r\n");
      part.insert(part.end(), picture.begin(), picture.end());
      append(part, "\r\n");
    }
    client.to_go = part;
  }
  next_picture_ = now + params_.period;
}

void MjpegPort::step(RobotTime now) {
  if (!acceptor_.is_open()) {
    return;
  }
  admit();
  clients_.remove_if([](Client& client) { return !receive(client); });
  if (now >= next_picture_) {
    show(now);
  }
  clients_.remove_if([](Client& client) { return !send(client); });
}

}  // namespace seeker::emulator
