// The kernel's structure termios2 and that of <termios.h> exclude each other: hence a source of its own.
#include "server/drivers/link/any_baud.hpp"

#include <asm/termbits.h>
#include <sys/ioctl.h>

#include <cerrno>

namespace seeker::drivers {

boost::system::error_code set_any_baud(int descriptor, std::uint32_t baud) {
  termios2 settings{};
  bool set = ::ioctl(descriptor, TCGETS2, &settings) == 0;
  if (set) {
    settings.c_cflag &= ~static_cast<tcflag_t>(CBAUD);
    settings.c_cflag |= BOTHER;
    settings.c_ispeed = baud;
    settings.c_ospeed = baud;
    set = ::ioctl(descriptor, TCSETS2, &settings) == 0;
  }
  return set ? boost::system::error_code() : boost::system::error_code(errno, boost::system::system_category());
}

}  // namespace seeker::drivers
