#include "client/cli/json.hpp"

#include <array>
#include <cmath>
#include <cstdio>

namespace seeker::cli {
namespace {

void append_escaped(std::string& out, std::string_view text) {
  out += '"';
  for (const char c : text) {
    switch (c) {
      case '"': out += "\\\""; break;
      case '\\': out += "\\\\"; break;
      case '\n': out += "\\n"; break;
      case '\r': out += "\\r"; break;
      case '\t': out += "\\t"; break;
      default:
        if (static_cast<unsigned char>(c) < 0x20U) {
          std::array<char, 8> code{};
          std::snprintf(code.data(), code.size(), "\\u%04x", static_cast<unsigned>(static_cast<unsigned char>(c)));
          out += code.data();
        } else {
          out += c;
        }
    }
  }
  out += '"';
}

}  // namespace

void Json::separate() {
  if (!first_) {
    text_ += ',';
  }
  first_ = false;
}

Json& Json::open(char bracket) {
  separate();
  text_ += bracket;
  first_ = true;
  return *this;
}

Json& Json::close(char bracket) {
  text_ += bracket;
  first_ = false;
  return *this;
}

Json& Json::raw(std::string_view text) {
  separate();
  text_ += text;
  return *this;
}

Json& Json::key(std::string_view name) {
  separate();
  append_escaped(text_, name);
  text_ += ':';
  first_ = true;
  return *this;
}

Json& Json::value(std::string_view text) {
  separate();
  append_escaped(text_, text);
  return *this;
}

Json& Json::value(double number) {
  if (!std::isfinite(number)) {
    return null();
  }
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.10g", number);
  return raw(text.data());
}

Json& Json::value(const Point2& point) { return begin_array().value(point.x()).value(point.y()).end_array(); }

}  // namespace seeker::cli
