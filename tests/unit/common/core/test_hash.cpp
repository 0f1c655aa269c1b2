#include "common/core/hash.hpp"

#include <gtest/gtest.h>

namespace seeker {
namespace {

std::uint64_t hash_of(std::string_view text) {
  Fnv1a hash;
  hash.add(text);
  return hash.value();
}

TEST(Fnv1a, GivesThePublishedValues) {
  EXPECT_EQ(hash_of(""), 0xcbf29ce484222325ULL);
  EXPECT_EQ(hash_of("a"), 0xaf63dc4c8601ec8cULL);
  EXPECT_EQ(hash_of("foobar"), 0x85944171f73967e8ULL);
}

TEST(Fnv1a, NumbersAreTheirBytesLowestFirst) {
  Fnv1a number;
  number.add(std::uint64_t{0x0000000000636261});
  Fnv1a text;
  text.add(std::string_view("abc\0\0\0\0\0", 8));
  EXPECT_EQ(number.value(), text.value());
  Fnv1a negative;
  negative.add(std::int64_t{-1});
  Fnv1a ones;
  ones.add(~std::uint64_t{0});
  EXPECT_EQ(negative.value(), ones.value());
}

}  // namespace
}  // namespace seeker
