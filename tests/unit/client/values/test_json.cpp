#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "client/values/values_json.hpp"
#include "tests/support/json_text.hpp"

namespace seeker::cli {
namespace {

TEST(Json, EscapesAndNestsAsTheStandardAsks) {
  const Json list = Json::array({1, std::uint64_t{18446744073709551615U}, nullptr, Json::object()});
  const std::string line = json_line({{"text", "a\"b\\c\n\x01"}, {"n", 1.5}, {"flag", true}, {"list", list}});
  EXPECT_EQ(line, R"({"text":"a\"b\\c\n\u0001","n":1.5,"flag":true,"list":[1,18446744073709551615,null,{}]})");
  EXPECT_TRUE(testing::is_json(line));
}

TEST(Json, NumbersThatAreNoneBecomeNull) {
  EXPECT_EQ(json_line(Json::array({std::nan(""), std::numeric_limits<double>::infinity()})), "[null,null]");
}

TEST(Json, BytesThatAreNoUtf8AreReplaced) {
  EXPECT_EQ(json_line(Json::array({"caf\xE9", "caf\xC3\xA9"})), "[\"caf\xEF\xBF\xBD\",\"caf\xC3\xA9\"]");
}

TEST(Json, APointIsAListAndWhatIsAbsentIsNull) {
  const api::Gap gap{Point2(1.0, -2.5), 0.5, "not seen"};
  EXPECT_EQ(json_line(gap), R"({"centre":[1.0,-2.5],"area_m2":0.5,"reason":"not seen"})");
  EXPECT_EQ(json_line(or_null(std::optional<api::Gap>())), "null");
}

}  // namespace
}  // namespace seeker::cli
