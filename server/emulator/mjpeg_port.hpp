/// \file
/// An emulated network camera: pictures as Motion JPEG over HTTP.
#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <string>
#include <vector>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>

#include "common/core/image.hpp"
#include "common/core/result.hpp"
#include "common/core/time.hpp"

namespace seeker::emulator {

struct MjpegParams {
  std::string host = "127.0.0.1";
  std::uint16_t port = 0;  ///< 0: any free one
  Duration period = std::chrono::milliseconds(250);
  int quality = 90;
};

/// Sends a picture a period to every client that asks for `/camera.mjpg`. A client that reads too slowly
/// misses pictures. All calls return at once.
class MjpegPort {
 public:
  /// `take_picture` exposes a picture; it is called while there is a client only.
  MjpegPort(MjpegParams params, std::function<Image()> take_picture);

  /// Lets clients come. Errors are kIo.
  [[nodiscard]] Status plug();
  void unplug();
  /// The world has come to `now`.
  void step(RobotTime now);
  [[nodiscard]] std::string address() const;

 private:
  struct Client {
    boost::asio::ip::tcp::socket socket;
    std::string request;              ///< what has come of it
    bool asked = false;               ///< the request is whole
    bool ends = false;                ///< there is no picture for it: it is sent away when it has its answer
    std::vector<std::uint8_t> to_go;  ///< not sent yet
  };

  void admit();
  /// Returns false where the client is gone or sends nonsense.
  [[nodiscard]] static bool receive(Client& client);
  [[nodiscard]] static bool send(Client& client);
  static void answer(Client& client);
  void show(RobotTime now);

  MjpegParams params_;
  std::function<Image()> take_picture_;
  boost::asio::io_context io_{1};
  boost::asio::ip::tcp::acceptor acceptor_{io_};
  std::list<Client> clients_;
  RobotTime next_picture_;
};

}  // namespace seeker::emulator
