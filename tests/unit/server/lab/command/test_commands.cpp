/// What seeker-lab says of command lines that it cannot heed.
#include <array>

#include <gtest/gtest.h>

#include "server/lab/command/commands.hpp"

namespace seeker::lab {
namespace {

struct Answer {
  int code = 0;
  std::string error;
};

template <std::size_t n>
Answer ask(std::array<const char*, n> words) {
  ::testing::internal::CaptureStderr();
  Answer answer;
  answer.code = run_lab(static_cast<int>(n), const_cast<char**>(words.data()));
  answer.error = ::testing::internal::GetCapturedStderr();
  return answer;
}

TEST(ReproduceCommand, RefusesAnOptionThatTheReproductionWouldNotHeed) {
  const Answer set = ask(std::array{"seeker-lab", "reproduce", "r2", "--out", "unused", "--set", "slam.min_move_m=1"});
  EXPECT_NE(set.code, 0);
  EXPECT_NE(set.error.find("reproduce r2 takes no --set"), std::string::npos) << set.error;
  const Answer world = ask(std::array{"seeker-lab", "reproduce", "s5", "--out", "unused", "--world", "office"});
  EXPECT_NE(world.code, 0);
  EXPECT_NE(world.error.find("reproduce s5 takes no --world"), std::string::npos) << world.error;
}

TEST(ReproduceCommand, RefusesAWorldOfAnotherReproduction) {
  const Answer answer = ask(std::array{"seeker-lab", "reproduce", "s4", "--out", "unused", "--world", "office"});
  EXPECT_NE(answer.code, 0);
  EXPECT_NE(answer.error.find("its worlds are arena-20, other-buildings, twin-posters, half-turn, twin-corridors"),
            std::string::npos)
      << answer.error;
}

}  // namespace
}  // namespace seeker::lab
