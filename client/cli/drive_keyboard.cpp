#include <array>
#include <atomic>
#include <csignal>
#include <string_view>

#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include "client/cli/verbs.hpp"

namespace seeker::cli {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr double kSpeed_m_s = 0.3;
constexpr double kTurn_rad_s = 0.6;
constexpr Duration kTick = std::chrono::milliseconds(50);
/// A held key repeats; a terminal waits this long before it does.
constexpr Duration kFirstRepeat = std::chrono::milliseconds(550);
constexpr Duration kNextRepeat = std::chrono::milliseconds(180);

/// Keys as they are pressed, without echo, until the end of the scope.
class RawTerminal {
 public:
  RawTerminal() {
    ok_ = ::tcgetattr(STDIN_FILENO, &former_) == 0;
    if (ok_) {
      termios raw = former_;
      raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
      ok_ = ::tcsetattr(STDIN_FILENO, TCSANOW, &raw) == 0;
    }
  }
  RawTerminal(const RawTerminal&) = delete;
  RawTerminal& operator=(const RawTerminal&) = delete;
  ~RawTerminal() {
    if (ok_) {
      ::tcsetattr(STDIN_FILENO, TCSANOW, &former_);
    }
  }
  [[nodiscard]] bool ok() const { return ok_; }

 private:
  termios former_{};
  bool ok_ = false;
};

std::atomic<bool> hung_up{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set in a signal handler");

extern "C" void on_hang_up(int /*signal*/) { hung_up = true; }

/// Until the end of the scope the end of the terminal's session ends the driving, not the program: the robot is
/// commanded to stand still and the terminal is set back. A mission's client dies of it, and the link policy says what
/// follows.
class HangUp {
 public:
  HangUp() {
    hung_up = false;
    struct sigaction action {};
    action.sa_handler = on_hang_up;
    ::sigaction(SIGHUP, &action, &former_);
  }
  HangUp(const HangUp&) = delete;
  HangUp& operator=(const HangUp&) = delete;
  ~HangUp() { ::sigaction(SIGHUP, &former_, nullptr); }

 private:
  struct sigaction former_ {};
};

enum class Key : std::uint8_t { kNone, kForward, kBack, kLeft, kRight, kStop, kQuit };

Key key_of(std::string_view bytes) {
  if (bytes == "w" || bytes == "\x1b[A") {
    return Key::kForward;
  }
  if (bytes == "s" || bytes == "\x1b[B") {
    return Key::kBack;
  }
  if (bytes == "a" || bytes == "\x1b[D") {
    return Key::kLeft;
  }
  if (bytes == "d" || bytes == "\x1b[C") {
    return Key::kRight;
  }
  if (bytes == "q" || bytes == "\x1b" || bytes == "\x04") {
    return Key::kQuit;
  }
  return bytes.empty() ? Key::kNone : Key::kStop;
}

Twist2 velocity_of(Key key) {
  switch (key) {
    case Key::kForward: return {kSpeed_m_s, 0.0};
    case Key::kBack: return {-kSpeed_m_s, 0.0};
    case Key::kLeft: return {0.0, kTurn_rad_s};
    case Key::kRight: return {0.0, -kTurn_rad_s};
    default: return {};
  }
}

/// Waits for one key; kQuit at the end of the input.
Key read_key(Duration wait) {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  const auto wait_ms = static_cast<int>(std::chrono::duration_cast<std::chrono::milliseconds>(wait).count());
  if (::poll(&input, 1, wait_ms) <= 0) {
    return Key::kNone;
  }
  std::array<char, 8> bytes{};
  const ssize_t count = ::read(STDIN_FILENO, bytes.data(), bytes.size());
  if (count <= 0) {
    return Key::kQuit;
  }
  const std::string_view text(bytes.data(), static_cast<std::size_t>(count));
  // Several repeats in one read: the last one counts.
  return text.front() == '\x1b' ? key_of(text.substr(0, 3)) : key_of(text.substr(text.size() - 1));
}

}  // namespace

Status drive_by_keyboard(const Context& context, HeldLease& lease) {
  if (::isatty(STDIN_FILENO) == 0) {
    return fail(Errc::kInvalidArgument,
                "driving by keyboard needs a terminal; give a velocity, as in seeker drive 0.2 0");
  }
  const HangUp hang_up;
  const RawTerminal terminal;
  if (!terminal.ok()) {
    return fail(Errc::kIo, "the terminal cannot be read key by key; give a velocity, as in seeker drive 0.2 0");
  }
  say(context, "hold an arrow or w a s d to move, space stops, q ends");
  Key held = Key::kNone;
  SteadyClock::time_point until;
  for (;;) {
    const Key key = read_key(kTick);
    const auto now = SteadyClock::now();
    const bool interrupted = context.interrupted() || hung_up;
    const bool quit = key == Key::kQuit || interrupted;
    if (key != Key::kNone) {
      until = now + (key == held ? kNextRepeat : kFirstRepeat);
      held = key;
    } else if (now >= until) {
      held = Key::kNone;
    }
    Context calm = context;
    calm.interrupted = [] { return false; };
    const Twist2 velocity = quit ? Twist2{} : velocity_of(held);
    const Status sent = ask<void>(
        calm, [&](api::Reply<void> reply) { context.robot->drive(lease.command(velocity), std::move(reply)); });
    if (sent && interrupted) {
      return fail(Errc::kCancelled, "interrupted; the robot was commanded to stop");
    }
    if (!sent || quit) {
      return sent;
    }
  }
}

}  // namespace seeker::cli
