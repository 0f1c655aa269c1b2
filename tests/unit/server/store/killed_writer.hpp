/// \file
/// A process that writes until it is killed: for tests of what is on the disk afterwards.
#pragma once

#include <csignal>
#include <cstdint>
#include <functional>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace seeker::testing {

/// Starts a process that calls write_one(1), write_one(2), ... and tells of each one done; a false ends it as failed.
/// Kills it once it told of `steps` of them and `extra` more turns of a busy wait have passed: anywhere inside the
/// next one; how long a turn takes does not matter. How many it had told of in the end.
inline std::uint64_t kill_a_writer(const std::function<bool(std::uint64_t)>& write_one, std::uint64_t steps,
                                   std::uint64_t extra) {
  int pipe_ends[2];
  EXPECT_EQ(::pipe(pipe_ends), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(pipe_ends[0]);
    for (std::uint64_t n = 1;; ++n) {
      const char told = 1;
      if (!write_one(n) || ::write(pipe_ends[1], &told, 1) != 1) {
        _exit(1);
      }
    }
  }
  ::close(pipe_ends[1]);
  std::uint64_t told = 0;
  char byte = 0;
  while (told < steps && ::read(pipe_ends[0], &byte, 1) == 1) {
    ++told;
  }
  volatile std::uint64_t turns = 0;
  while (turns < extra) {
    turns = turns + 1;
  }
  EXPECT_EQ(::kill(child, SIGKILL), 0);
  int status = 0;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFSIGNALED(status)) << "the writer failed by itself";
  while (::read(pipe_ends[0], &byte, 1) == 1) {
    ++told;
  }
  ::close(pipe_ends[0]);
  return told;
}

}  // namespace seeker::testing
