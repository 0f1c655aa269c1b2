#include <gtest/gtest.h>

#include "common/net/connect.hpp"

namespace seeker::net {
namespace {

using std::chrono::milliseconds;

TEST(Backoff, DoublesUpToItsLimitAndStartsAgainAfterSuccess) {
  Backoff backoff(milliseconds(100), milliseconds(350));
  EXPECT_EQ(backoff.next(), milliseconds(100));
  EXPECT_EQ(backoff.next(), milliseconds(200));
  EXPECT_EQ(backoff.next(), milliseconds(350));
  EXPECT_EQ(backoff.next(), milliseconds(350));
  backoff.reset();
  EXPECT_EQ(backoff.next(), milliseconds(100));
}

TEST(Backoff, FirstAttemptAfterAConnectionThatLastedIsMadeAtOnce) {
  Backoff backoff(milliseconds(100), milliseconds(350));
  EXPECT_EQ(backoff.next(), milliseconds(100));
  EXPECT_EQ(backoff.after(milliseconds(100)), milliseconds(0));
  EXPECT_EQ(backoff.next(), milliseconds(100)) << "when that fails it is as after any success";
  EXPECT_EQ(backoff.next(), milliseconds(200));
}

TEST(Backoff, ConnectionThatBreaksAtOnceIsNotMadeMoreOftenThanAtTheFirstDelay) {
  Backoff backoff(milliseconds(100), milliseconds(350));
  EXPECT_EQ(backoff.after(milliseconds(0)), milliseconds(100));
  EXPECT_EQ(backoff.after(milliseconds(30)), milliseconds(70));
}

}  // namespace
}  // namespace seeker::net
