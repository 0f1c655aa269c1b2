#include <gtest/gtest.h>

#include "common/rpc/endpoint.hpp"

namespace seeker::rpc {
namespace {

TEST(Endpoint, IsReadAsPeopleWriteIt) {
  EXPECT_EQ(parse_endpoint("robot"), (Endpoint{"robot", 7471}));
  EXPECT_EQ(parse_endpoint("robot:80"), (Endpoint{"robot", 80}));
  EXPECT_EQ(parse_endpoint("10.0.0.7:7000"), (Endpoint{"10.0.0.7", 7000}));
  EXPECT_EQ(parse_endpoint("[::1]"), (Endpoint{"::1", 7471}));
  EXPECT_EQ(parse_endpoint("[fe80::1]:9"), (Endpoint{"fe80::1", 9}));
}

TEST(Endpoint, WhatItCannotBeIsRefused) {
  for (const char* text : {"", ":80", "robot:", "robot:0", "robot:65536", "robot:x", "robot:1x", "::1", "[::1", "[]",
                           "[::1]80", "a b", "robot:-1"}) {
    EXPECT_FALSE(parse_endpoint(text)) << text;
  }
}

TEST(Endpoint, IsWrittenSoThatItCanBeRead) {
  for (const Endpoint& endpoint : {Endpoint{"robot", 7471}, Endpoint{"::1", 9}}) {
    EXPECT_EQ(parse_endpoint(to_string(endpoint)), endpoint);
  }
}

TEST(Endpoint, LoopbackIsThisMachine) {
  for (const char* host : {"localhost", "127.0.0.1", "127.8.8.8", "::1"}) {
    EXPECT_TRUE(is_this_machine(host)) << host;
  }
  for (const char* host : {"robot", "10.0.0.1", "::2", "1270.example"}) {
    EXPECT_FALSE(is_this_machine(host)) << host;
  }
}

}  // namespace
}  // namespace seeker::rpc
