#include "common/net/address_guard.hpp"

#include <gtest/gtest.h>

#include "common/net/refusal_log.hpp"

namespace seeker::net {
namespace {

using boost::asio::ip::make_address;
using std::chrono::milliseconds;
using std::chrono::seconds;

const wire::WallTime kStart{seconds(1000)};
const boost::asio::ip::address kHost = make_address("10.0.0.7");

LockoutParams three() {
  LockoutParams params;
  params.failures = 3;
  return params;
}

TEST(AddressGuard, ShutsAnAddressOutAfterItsFailuresAndLetsItInAgain) {
  AddressGuard guard(three());
  EXPECT_FALSE(guard.failed(kHost, kStart));
  EXPECT_FALSE(guard.failed(kHost, kStart + seconds(1)));
  EXPECT_TRUE(guard.admits(kHost, kStart + seconds(1)));
  EXPECT_TRUE(guard.failed(kHost, kStart + seconds(2)));
  EXPECT_FALSE(guard.admits(kHost, kStart + seconds(61)));
  EXPECT_TRUE(guard.admits(make_address("10.0.0.8"), kStart + seconds(2)));
  EXPECT_TRUE(guard.admits(kHost, kStart + seconds(62)));
}

TEST(AddressGuard, ForgetsFailuresThatAreLongAgo) {
  AddressGuard guard(three());
  for (int k = 0; k < 20; ++k) {
    EXPECT_FALSE(guard.failed(kHost, kStart + k * seconds(31)));
  }
}

TEST(AddressGuard, LeavesThisMachineAloneWhereItIsToldTo) {
  LockoutParams params = three();
  params.loopback = false;
  AddressGuard guard(params);
  for (int k = 0; k < 10; ++k) {
    EXPECT_FALSE(guard.failed(make_address("127.0.0.1"), kStart));
    EXPECT_FALSE(guard.failed(make_address("::1"), kStart));
  }
  EXPECT_EQ(guard.known(), 0U);
}

TEST(AddressGuard, TakesANetworkOfIPv6AsOneAndAMappedAddressAsIPv4) {
  AddressGuard guard(three());
  EXPECT_FALSE(guard.failed(make_address("2001:db8::1"), kStart));
  EXPECT_FALSE(guard.failed(make_address("2001:db8::2"), kStart));
  EXPECT_TRUE(guard.failed(make_address("2001:db8::3"), kStart));
  EXPECT_FALSE(guard.admits(make_address("2001:db8::4"), kStart));
  EXPECT_TRUE(guard.admits(make_address("2001:db8:0:1::4"), kStart));
  EXPECT_FALSE(guard.failed(make_address("::ffff:10.0.0.7"), kStart));
  EXPECT_FALSE(guard.failed(kHost, kStart));
  EXPECT_TRUE(guard.failed(kHost, kStart));
}

TEST(AddressGuard, RemembersABoundedNumberOfAddresses) {
  LockoutParams params = three();
  params.addresses = 8;
  AddressGuard guard(params);
  for (unsigned k = 0; k < 1000; ++k) {
    static_cast<void>(guard.failed(boost::asio::ip::address_v4(0x0A000000U + k), kStart + milliseconds(k)));
  }
  EXPECT_EQ(guard.known(), 8U);
}

TEST(RefusalLog, WritesOneLinePerPeriodWithTheNumberOfThoseItStandsFor) {
  RefusalLog log{seconds(1)};
  EXPECT_EQ(log.note("a", kStart), "a connection was refused: a");
  EXPECT_EQ(log.note("b", kStart + milliseconds(100)), std::nullopt);
  EXPECT_EQ(log.note("c", kStart + milliseconds(200)), std::nullopt);
  EXPECT_EQ(log.take(kStart + milliseconds(900)), std::nullopt);
  EXPECT_EQ(log.take(kStart + milliseconds(1100)), "2 connections were refused, the last: c");
  EXPECT_EQ(log.take(kStart + milliseconds(9000)), std::nullopt);
}

}  // namespace
}  // namespace seeker::net
