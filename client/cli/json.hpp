/// \file
/// A strict JSON writer: one document on one line, escaped as RFC 8259 asks. A number that is not finite is null.
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>

#include "common/core/pose2.hpp"

namespace seeker::cli {

class Json {
 public:
  Json& begin_object() { return open('{'); }
  Json& end_object() { return close('}'); }
  Json& begin_array() { return open('['); }
  Json& end_array() { return close(']'); }
  Json& key(std::string_view name);

  Json& value(std::string_view text);
  Json& value(const char* text) { return value(std::string_view(text)); }
  Json& value(const std::string& text) { return value(std::string_view(text)); }
  Json& value(double number);
  Json& value(const Point2& point);  ///< [x, y]
  template <std::same_as<bool> T>
  Json& value(T flag) {
    return raw(flag ? "true" : "false");
  }
  template <std::integral T>
  requires(!std::same_as<T, bool>) Json& value(T number) { return raw(std::to_string(number)); }
  Json& null() { return raw("null"); }

  template <class T>
  Json& field(std::string_view name, const T& v) {
    return key(name).value(v);
  }

  [[nodiscard]] const std::string& str() const { return text_; }

 private:
  Json& open(char bracket);
  Json& close(char bracket);
  Json& raw(std::string_view text);
  void separate();

  std::string text_;
  bool first_ = true;
};

}  // namespace seeker::cli
