/// \file
/// The line to a device: a serial port or a TCP connection.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include <boost/asio/io_context.hpp>

#include "common/core/result.hpp"
#include "common/core/time.hpp"
#include "server/drivers/link/line_address.hpp"

namespace seeker::drivers {

/// An open line. All calls come from the thread of its io_context, which also calls the handlers; none is called after
/// the line was destroyed. Errors are kLinkLost and name the line.
class Line {
 public:
  using Received = std::function<void(Result<std::span<const std::uint8_t>>)>;
  using Written = std::function<void(Status)>;

  Line() = default;
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;
  virtual ~Line() = default;

  /// Calls `done` with the next bytes; they are valid during the call. One read at a time.
  virtual void read(Received done) = 0;
  /// Writes all of the bytes, then calls `done`. One write at a time.
  virtual void write(std::vector<std::uint8_t> bytes, Written done) = 0;
  /// Waits until everything written has left, then changes the rate. A TCP line does nothing.
  [[nodiscard]] virtual Status set_baud(std::uint32_t baud) = 0;
  /// Sets the modem line DTR. A line that has none (TCP, a pseudo-terminal) does nothing.
  virtual void set_dtr(bool on) = 0;
  /// Drops what was received and not read yet.
  virtual void drop_input() = 0;
};

/// Opens a line within `timeout` and calls `done` once. A serial port is opened with 8 data bits, no parity, one stop
/// bit, no flow control, and for this program alone. kLinkLost, kTimeout, kNotFound or kRefused say what to check.
void open_line(boost::asio::io_context& io, const LineAddress& address, Duration timeout,
               std::function<void(Result<std::unique_ptr<Line>>)> done);

}  // namespace seeker::drivers
