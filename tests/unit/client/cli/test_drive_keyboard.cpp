#include <csignal>
#include <cstdlib>

#include <fcntl.h>
#include <termios.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "tests/unit/client/cli/cli_fixture.hpp"

namespace seeker::cli {
namespace {

/// A terminal of its own on stdin.
class DriveByKeyboard : public ::testing::Test, public CliFixture {
 protected:
  void SetUp() override {
    keys_ = ::posix_openpt(O_RDWR | O_NOCTTY);
    ASSERT_GE(keys_, 0);
    ASSERT_EQ(::grantpt(keys_), 0);
    ASSERT_EQ(::unlockpt(keys_), 0);
    const int terminal = ::open(::ptsname(keys_), O_RDWR | O_NOCTTY);
    ASSERT_GE(terminal, 0);
    former_stdin_ = ::dup(STDIN_FILENO);
    ASSERT_GE(::dup2(terminal, STDIN_FILENO), 0);
    ::close(terminal);
  }
  void TearDown() override {
    ::dup2(former_stdin_, STDIN_FILENO);
    ::close(former_stdin_);
    ::close(keys_);
  }

  [[nodiscard]] static bool key_by_key() {
    termios now{};
    EXPECT_EQ(::tcgetattr(STDIN_FILENO, &now), 0);
    return (now.c_lflag & static_cast<tcflag_t>(ICANON | ECHO)) == 0;
  }
  /// Drives until the robot has had a command, then does `end`.
  Ran drive_until(const std::function<void()>& end) {
    return run({"drive"}, [&] {
      while (host->values().drives.empty()) {
        std::this_thread::yield();
      }
      EXPECT_TRUE(key_by_key());
      end();
    });
  }
  void press(char key) const { EXPECT_EQ(::write(keys_, &key, 1), 1); }

  int keys_ = -1;
  int former_stdin_ = -1;
};

TEST_F(DriveByKeyboard, TheKeyThatEndsItIsSuccess) {
  const Ran ran = drive_until([&] { press('q'); });
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_FALSE(key_by_key());
}

TEST_F(DriveByKeyboard, CtrlCIs130AndTheRobotStands) {
  const Ran ran = drive_until([&] { interrupted = true; });
  EXPECT_EQ(ran.code, 130) << ran.err;
  EXPECT_EQ(host->values().drives.back().velocity, Twist2{});
  EXPECT_TRUE(host->values().lease.owner.empty());
  EXPECT_FALSE(key_by_key());
}

TEST_F(DriveByKeyboard, TheEndOfTheSessionSetsTheTerminalBack) {
  const Ran ran = drive_until([] { EXPECT_EQ(::kill(::getpid(), SIGHUP), 0); });
  EXPECT_EQ(ran.code, 130) << ran.err;
  EXPECT_EQ(host->values().drives.back().velocity, Twist2{});
  EXPECT_FALSE(key_by_key());
}

}  // namespace
}  // namespace seeker::cli
