#include "server/net/once_calls.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace seeker::server_net {
namespace {

namespace pb = ::seeker::v1;

pb::Request stop(std::uint64_t once) {
  pb::Request request;
  request.mutable_stop()->set_once(once);
  return request;
}

pb::Request copy_of(pb::Request request) {
  request.mutable_stop()->set_copy(true);
  return request;
}

pb::Request estop(bool engaged, std::uint64_t once) {
  pb::Request request;
  request.mutable_set_estop()->set_engaged(engaged);
  request.mutable_set_estop()->set_once(once);
  return request;
}

class OnceCallsTest : public ::testing::Test {
 protected:
  void come(const pb::Request& request) {
    calls_.carry_out(
        request, [this](const Status& answer) { answers_.push_back(answer); },
        [this](const api::Reply<void>& done) { carried_out_.push_back(done); });
  }

  OnceCalls calls_;
  std::vector<api::Reply<void>> carried_out_;
  std::vector<Status> answers_;
};

TEST_F(OnceCallsTest, CopiesAreCarriedOutOnceAndAllAnswered) {
  EXPECT_FALSE(calls_.known(stop(7)));
  come(copy_of(stop(7)));
  EXPECT_TRUE(calls_.known(stop(7)));
  come(copy_of(stop(7)));
  ASSERT_EQ(carried_out_.size(), 1U);
  EXPECT_TRUE(answers_.empty()) << "it is not done yet";
  carried_out_.front()(fail(Errc::kNotReady, "the disk is full"));
  come(copy_of(stop(7)));
  EXPECT_EQ(carried_out_.size(), 1U);
  ASSERT_EQ(answers_.size(), 3U);
  for (const Status& answer : answers_) {
    ASSERT_FALSE(answer);
    EXPECT_EQ(answer.error(), (Error{Errc::kNotReady, "the disk is full"}));
  }
}

TEST_F(OnceCallsTest, TheRequestItselfIsCarriedOutAfterItsCopyAndItsCopyNotAfterIt) {
  come(copy_of(stop(7)));
  come(stop(7));
  EXPECT_EQ(carried_out_.size(), 2U);
  come(copy_of(stop(7)));
  EXPECT_EQ(carried_out_.size(), 2U);
}

TEST_F(OnceCallsTest, ANumberThatIsUsedAgainHidesNothing) {
  come(copy_of(stop(7)));
  EXPECT_TRUE(calls_.known(stop(7))) << "its copy was told";
  come(stop(7));
  EXPECT_FALSE(calls_.known(stop(7))) << "another request";
  EXPECT_TRUE(calls_.known(copy_of(stop(7))));
}

TEST_F(OnceCallsTest, ThoseWhoWaitAreBounded) {
  constexpr int kMany = 1000;
  for (int k = 0; k < kMany; ++k) {
    come(copy_of(stop(7)));
  }
  ASSERT_FALSE(answers_.empty());
  EXPECT_EQ(answers_.front().error().code, Errc::kBusy);
  carried_out_.front()({});
  EXPECT_EQ(answers_.size(), 1U * kMany) << "each one is answered";
}

TEST_F(OnceCallsTest, OtherNumbersAndOtherCallsAreNoCopies) {
  come(stop(7));
  come(stop(8));
  come(estop(true, 7));
  EXPECT_EQ(carried_out_.size(), 3U);
}

TEST_F(OnceCallsTest, WithoutANumberEachOneIsCarriedOut) {
  come(stop(0));
  come(stop(0));
  come(estop(false, 5));
  come(estop(false, 5));
  EXPECT_EQ(carried_out_.size(), 4U) << "a release is not copied, so its number means nothing";
}

TEST_F(OnceCallsTest, WhatIsRememberedIsBounded) {
  constexpr std::uint64_t kMany = 1000;
  for (std::uint64_t once = 1; once <= kMany; ++once) {
    come(stop(once));
  }
  EXPECT_TRUE(calls_.known(copy_of(stop(kMany))));
  EXPECT_FALSE(calls_.known(copy_of(stop(1))));
  carried_out_.front()({});
  EXPECT_EQ(answers_.size(), 1U) << "one that is forgotten is answered all the same";
}

}  // namespace
}  // namespace seeker::server_net
