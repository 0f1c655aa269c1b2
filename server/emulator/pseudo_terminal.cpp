#include "server/emulator/pseudo_terminal.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>

// Not termios.h: it hides the field that holds rates which are not in its list.
#include <asm/termbits.h>
#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace seeker::emulator {
namespace {

tl::unexpected<Error> no_terminal(const std::string& what) {
  return fail(Errc::kIo, "no pseudo-terminal: " + what + ": " + std::strerror(errno));
}

int open_master() {
  const int master = ::open("/dev/ptmx", O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  int unlocked = 0;
  if (master >= 0 && ::ioctl(master, TIOCSPTLCK, &unlocked) != 0) {
    ::close(master);
    return -1;
  }
  return master;
}

/// Bytes as they are, until the host sets the port up: else the terminal would answer with its echo.
void make_raw(int terminal) {
  struct termios2 settings {};
  if (::ioctl(terminal, TCGETS2, &settings) == 0) {
    settings.c_iflag = 0;
    settings.c_oflag = 0;
    settings.c_lflag = 0;
    settings.c_cflag = (settings.c_cflag & ~static_cast<tcflag_t>(CSIZE)) | CS8 | CREAD | CLOCAL;
    ::ioctl(terminal, TCSETS2, &settings);
  }
}

}  // namespace

Status PseudoTerminal::plug() {
  unplug();
  master_ = open_master();
  if (master_ < 0) {
    return no_terminal("/dev/ptmx");
  }
  unsigned number = 0;
  if (::ioctl(master_, TIOCGPTN, &number) != 0) {
    return no_terminal("its number");
  }
  const std::string name = "/dev/pts/" + std::to_string(number);
  slave_ = ::open(name.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (slave_ < 0) {
    return no_terminal(name);
  }
  make_raw(slave_);
  std::error_code error;
  std::filesystem::remove(link_, error);
  std::filesystem::create_symlink(name, link_, error);
  return error ? fail(Errc::kIo, link_.string() + " cannot be made: " + error.message() +
                                     "; name a path in a folder that may be written")
               : Status();
}

void PseudoTerminal::unplug() {
  for (int* end : {&slave_, &master_}) {
    if (*end >= 0) {
      ::close(*end);
      *end = -1;
    }
  }
  std::error_code ignored;
  if (std::filesystem::is_symlink(link_, ignored)) {
    std::filesystem::remove(link_, ignored);
  }
}

std::vector<std::uint8_t> PseudoTerminal::receive() {
  std::array<std::uint8_t, 4096> chunk;
  const ssize_t count = master_ < 0 ? 0 : ::read(master_, chunk.data(), chunk.size());
  return count > 0 ? std::vector<std::uint8_t>(chunk.begin(), chunk.begin() + count) : std::vector<std::uint8_t>();
}

void PseudoTerminal::send(std::span<const std::uint8_t> bytes) {
  if (master_ >= 0 && !bytes.empty()) {
    [[maybe_unused]] const ssize_t taken = ::write(master_, bytes.data(), bytes.size());
  }
}

std::uint32_t PseudoTerminal::host_baud() const {
  struct termios2 settings {};
  return master_ >= 0 && ::ioctl(master_, TCGETS2, &settings) == 0 ? settings.c_ospeed : 0;
}

}  // namespace seeker::emulator
