#include "server/drivers/link/serial_line.hpp"

#include <sys/ioctl.h>
#include <termios.h>

#include "server/drivers/link/any_baud.hpp"

namespace seeker::drivers {
namespace {

namespace asio = boost::asio;
using boost::system::error_code;

constexpr std::uint32_t kFirstBaud = 9600;

std::string remedy_for(const error_code& error, const std::string& path) {
  if (error == boost::system::errc::permission_denied) {
    return "add the user to the group that owns it (dialout), or install the udev rules";
  }
  if (error == boost::system::errc::no_such_file_or_directory) {
    return "plug the device in, and see 'ls -l /dev/serial/by-id' for its name";
  }
  if (error == boost::system::errc::device_or_resource_busy) {
    return "another program has opened it; end that one";
  }
  return "check that " + path + " is a serial port";
}

/// Binary bytes both ways, and no second program that takes half of them.
Status set_up(asio::serial_port& port) {
  using Option = asio::serial_port;
  error_code error;
  port.set_option(Option::character_size(8), error);
  if (!error) {
    port.set_option(Option::parity(Option::parity::none), error);
  }
  if (!error) {
    port.set_option(Option::stop_bits(Option::stop_bits::one), error);
  }
  if (!error) {
    port.set_option(Option::flow_control(Option::flow_control::none), error);
  }
  if (!error) {
    port.set_option(Option::baud_rate(kFirstBaud), error);
  }
  if (error) {
    return fail(Errc::kIo, error.message());
  }
  termios settings{};
  if (::tcgetattr(port.native_handle(), &settings) == 0) {
    settings.c_cflag &= ~static_cast<tcflag_t>(HUPCL);  // DTR stays as it is at the end: an RPLIDAR A1 would turn again
    ::tcsetattr(port.native_handle(), TCSANOW, &settings);
  }
  ::ioctl(port.native_handle(), TIOCEXCL);  // a pseudo-terminal may refuse, which harms nothing
  return {};
}

}  // namespace

Result<std::unique_ptr<Line>> SerialLine::open(asio::io_context& io, const std::string& path) {
  asio::serial_port port(io);
  error_code error;
  port.open(path, error);
  if (error) {
    return fail(Errc::kLinkLost, path + " cannot be opened: " + error.message() + "; " + remedy_for(error, path));
  }
  if (const Status ok = set_up(port); !ok) {
    return fail(Errc::kLinkLost,
                path + " does not take its settings: " + ok.error().message + "; check that it is a serial port");
  }
  return std::make_unique<SerialLine>(std::move(port), path);
}

Status SerialLine::set_baud(std::uint32_t baud) {
  ::tcdrain(stream().native_handle());
  error_code error;
  stream().set_option(asio::serial_port::baud_rate(baud), error);
  if (error) {
    // Asio knows the rates of POSIX only; 256000 of an RPLIDAR A3 is none of them.
    error = set_any_baud(stream().native_handle(), baud);
  }
  return error ? fail(Errc::kLinkLost, name() + " does not know " + std::to_string(baud) + " baud: " + error.message() +
                                           "; choose another rate")
               : Status();
}

void SerialLine::set_dtr(bool on) {
  const int line = TIOCM_DTR;
  // A pseudo-terminal has no modem lines: its device goes without.
  ::ioctl(stream().native_handle(), on ? TIOCMBIS : TIOCMBIC, &line);
}

void SerialLine::drop_input() { ::tcflush(stream().native_handle(), TCIFLUSH); }

}  // namespace seeker::drivers
