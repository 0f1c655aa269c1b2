/// \file
/// A serial port, or a pseudo-terminal that stands for one.
#pragma once

#include <boost/asio/serial_port.hpp>

#include "server/drivers/link/stream_line.hpp"

namespace seeker::drivers {

class SerialLine final : public StreamLine<boost::asio::serial_port> {
 public:
  /// Opens the port at 9600 baud with 8 data bits, no parity, one stop bit and no flow control, for this program alone.
  [[nodiscard]] static Result<std::unique_ptr<Line>> open(boost::asio::io_context& io, const std::string& path);

  using StreamLine::StreamLine;
  [[nodiscard]] Status set_baud(std::uint32_t baud) override;
  void set_dtr(bool on) override;
  void drop_input() override;
};

}  // namespace seeker::drivers
