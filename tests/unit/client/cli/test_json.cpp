#include "client/cli/json.hpp"

#include <cctype>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/unit/client/cli/cli_fixture.hpp"

namespace seeker::cli {
namespace {

class JsonChecker {
 public:
  explicit JsonChecker(const std::string& text) : text_(text) {}
  bool document() {
    const bool ok = value();
    space();
    return ok && at_ == text_.size();
  }

 private:
  void space() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) {
      ++at_;
    }
  }
  bool take(char c) {
    space();
    if (at_ < text_.size() && text_[at_] == c) {
      ++at_;
      return true;
    }
    return false;
  }
  bool word(const std::string& w) {
    if (text_.compare(at_, w.size(), w) == 0) {
      at_ += w.size();
      return true;
    }
    return false;
  }
  bool string() {
    if (!take('"')) {
      return false;
    }
    while (at_ < text_.size() && text_[at_] != '"') {
      if (static_cast<unsigned char>(text_[at_]) < 0x20U) {
        return false;
      }
      at_ += text_[at_] == '\\' ? 2 : 1;
    }
    return take('"');
  }
  bool number() {
    const std::size_t start = at_;
    while (at_ < text_.size() && std::string("+-0123456789.eE").find(text_[at_]) != std::string::npos) {
      ++at_;
    }
    return at_ > start;
  }
  bool list(char end, bool keyed) {
    if (take(end)) {
      return true;
    }
    do {
      if (keyed && !(string() && take(':'))) {
        return false;
      }
      if (!value()) {
        return false;
      }
    } while (take(','));
    return take(end);
  }
  bool value() {
    space();
    if (take('{')) {
      return list('}', true);
    }
    if (take('[')) {
      return list(']', false);
    }
    if (at_ < text_.size() && text_[at_] == '"') {
      return string();
    }
    return word("true") || word("false") || word("null") || number();
  }

  const std::string& text_;
  std::size_t at_ = 0;
};

}  // namespace

bool is_json(const std::string& text) { return JsonChecker(text).document(); }

namespace {

TEST(Json, EscapesAndNestsAsTheStandardAsks) {
  Json json;
  json.begin_object().field("text", "a\"b\\c\n\x01").field("n", 1.5).field("flag", true).key("list").begin_array();
  json.value(1).value(std::uint64_t{18446744073709551615U}).null().begin_object().end_object().end_array().end_object();
  EXPECT_EQ(json.str(), R"({"text":"a\"b\\c\n\u0001","n":1.5,"flag":true,"list":[1,18446744073709551615,null,{}]})");
  EXPECT_TRUE(is_json(json.str()));
}

TEST(Json, NumbersThatAreNoneBecomeNull) {
  Json json;
  json.begin_array().value(std::nan("")).value(std::numeric_limits<double>::infinity()).end_array();
  EXPECT_EQ(json.str(), "[null,null]");
}

}  // namespace
}  // namespace seeker::cli
