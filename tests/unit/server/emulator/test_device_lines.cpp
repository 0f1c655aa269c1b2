#include <array>
#include <fstream>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <termios.h>
#include <unistd.h>
#include <boost/asio/connect.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>

#include "common/image/jpeg.hpp"
#include "server/emulator/mjpeg_port.hpp"
#include "server/emulator/pseudo_terminal.hpp"
#include "server/emulator/tcp_line.hpp"
#include "tests/support/process.hpp"

namespace seeker::emulator {
namespace {

using boost::asio::ip::tcp;
using Bytes = std::vector<std::uint8_t>;

/// Takes from the line until so many bytes have come.
Bytes take(DeviceLine& line, std::size_t count) {
  Bytes all;
  while (all.size() < count) {
    const Bytes more = line.receive();
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

TEST(PseudoTerminal, CarriesEveryByteBothWaysWithoutTranslation) {
  PseudoTerminal terminal(seeker::testing::fresh_folder("pty_bytes") / "port");
  ASSERT_TRUE(terminal.plug());
  Bytes all(256);
  for (std::size_t k = 0; k < all.size(); ++k) {
    all[k] = static_cast<std::uint8_t>(k);
  }
  const int host = ::open(terminal.address().c_str(), O_RDWR | O_NOCTTY);
  ASSERT_GE(host, 0);
  ASSERT_EQ(::write(host, all.data(), all.size()), static_cast<ssize_t>(all.size()));
  EXPECT_EQ(take(terminal, all.size()), all);
  terminal.send(all);
  Bytes heard(all.size());
  std::size_t count = 0;
  while (count < heard.size()) {
    const ssize_t more = ::read(host, heard.data() + count, heard.size() - count);
    ASSERT_GT(more, 0);
    count += static_cast<std::size_t>(more);
  }
  EXPECT_EQ(heard, all);
  ::close(host);
}

TEST(PseudoTerminal, ShowsTheRateThatTheHostChose) {
  PseudoTerminal terminal(seeker::testing::fresh_folder("pty_rate") / "port");
  ASSERT_TRUE(terminal.plug());
  const int host = ::open(terminal.address().c_str(), O_RDWR | O_NOCTTY);
  termios settings{};
  ASSERT_EQ(::tcgetattr(host, &settings), 0);
  ::cfsetspeed(&settings, B38400);
  ASSERT_EQ(::tcsetattr(host, TCSANOW, &settings), 0);
  EXPECT_EQ(terminal.host_baud(), 38400U);
  ::close(host);
}

TEST(PseudoTerminal, EndsForItsHostWhenItIsUnpluggedAndComesBackUnderItsName) {
  PseudoTerminal terminal(seeker::testing::fresh_folder("pty_plug") / "port");
  ASSERT_TRUE(terminal.plug());
  const int host = ::open(terminal.address().c_str(), O_RDWR | O_NOCTTY);
  terminal.unplug();
  std::array<char, 1> byte{};
  EXPECT_LE(::read(host, byte.data(), 1), 0);
  EXPECT_FALSE(std::filesystem::exists(terminal.address()));
  ::close(host);
  ASSERT_TRUE(terminal.plug());
  const int again = ::open(terminal.address().c_str(), O_RDWR | O_NOCTTY);
  EXPECT_GE(again, 0);
  ::close(again);
}

tcp::socket connect_to(boost::asio::io_context& io, const std::string& address) {
  const std::size_t colon = address.rfind(':');
  const auto port = static_cast<std::uint16_t>(std::stoi(address.substr(colon + 1)));
  tcp::socket socket(io);
  socket.connect(tcp::endpoint(boost::asio::ip::address_v4::loopback(), port));
  return socket;
}

TEST(TcpLine, CarriesBytesBothWaysAndKeepsItsPort) {
  TcpLine line("127.0.0.1", 0);
  ASSERT_TRUE(line.plug());
  const std::string address = line.address();
  boost::asio::io_context io;
  {
    tcp::socket host = connect_to(io, address);
    boost::asio::write(host, boost::asio::buffer(std::string("to the device")));
    EXPECT_EQ(take(line, 13).size(), 13U);
    line.send(Bytes{1, 2, 3});
    Bytes heard(3);
    boost::asio::read(host, boost::asio::buffer(heard));
    EXPECT_EQ(heard, (Bytes{1, 2, 3}));
    line.unplug();
    boost::system::error_code error;
    boost::asio::read(host, boost::asio::buffer(heard), error);
    EXPECT_TRUE(error);
  }
  ASSERT_TRUE(line.plug());
  EXPECT_EQ(line.address(), address);
}

TEST(MjpegPort, SendsPicturesToWhoeverAsks) {
  Image picture(32, 16, 1, 128);
  MjpegPort port({}, [&] { return picture; });
  ASSERT_TRUE(port.plug());
  const std::string address = port.address();
  boost::asio::io_context io;
  tcp::socket host = connect_to(io, address.substr(0, address.rfind('/')));
  boost::asio::write(host, boost::asio::buffer(std::string("GET /camera.mjpg HTTP/1.0\r\n\r\n")));
  host.non_blocking(true);
  std::string heard;
  for (double time_s = 0.0; heard.find("\xFF\xD9") == std::string::npos; time_s += 0.01) {
    port.step(robot_time_s(time_s));
    std::array<char, 1024> chunk{};
    boost::system::error_code error;
    heard.append(chunk.data(), host.read_some(boost::asio::buffer(chunk), error));
  }
  EXPECT_EQ(heard.rfind("HTTP/1.1 200 OK\r\n", 0), 0U);
  EXPECT_NE(heard.find("multipart/x-mixed-replace; boundary=frame"), std::string::npos);
  const std::size_t first = heard.find("\xFF\xD8");
  ASSERT_NE(first, std::string::npos);
  const std::string jpeg = heard.substr(first, heard.find("\xFF\xD9") + 2 - first);
  const auto decoded = image::decode_jpeg({reinterpret_cast<const std::uint8_t*>(jpeg.data()), jpeg.size()});
  ASSERT_TRUE(decoded) << decoded.error().message;
  EXPECT_EQ(decoded->width_px(), 32);
}

/// What the camera answers to a request that gets no pictures.
std::string answer_to(const std::string& request) {
  MjpegPort port({}, [] { return Image(8, 8, 1); });
  EXPECT_TRUE(port.plug());
  const std::string address = port.address();
  boost::asio::io_context io;
  tcp::socket host = connect_to(io, address.substr(0, address.rfind('/')));
  boost::asio::write(host, boost::asio::buffer(request));
  host.non_blocking(true);
  std::string heard;
  boost::system::error_code error;
  for (double time_s = 0.0; error != boost::asio::error::eof; time_s += 0.01) {
    port.step(robot_time_s(time_s));
    std::array<char, 1024> chunk{};
    heard.append(chunk.data(), host.read_some(boost::asio::buffer(chunk), error));
  }
  return heard;
}

TEST(MjpegPort, SendsAwayWhoeverAsksForSomethingElse) {
  EXPECT_EQ(answer_to("GET /nothing HTTP/1.1\r\n\r\n").rfind("HTTP/1.1 404 ", 0), 0U);
  EXPECT_EQ(answer_to("POST /camera.mjpg HTTP/1.1\r\n\r\n").rfind("HTTP/1.1 405 ", 0), 0U);
  EXPECT_EQ(answer_to("HEAD /camera.mjpg HTTP/1.1\r\n\r\n").rfind("HTTP/1.1 200 ", 0), 0U);
}

}  // namespace
}  // namespace seeker::emulator
