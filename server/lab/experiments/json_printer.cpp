#include "server/lab/experiments/json_printer.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "common/core/angle.hpp"

namespace seeker::lab {

std::string json_number(double value) {
  if (!std::isfinite(value)) {
    return "null";
  }
  std::array<char, 32> buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), result.ptr};
}

std::string json_string(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    constexpr unsigned char kFirstPrintable = 0x20;
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (c == '\n') {
      out += "\\n";
    } else if (static_cast<unsigned char>(c) < kFirstPrintable) {
      std::array<char, 8> code{};
      std::snprintf(code.data(), code.size(), "\\u%04x", static_cast<unsigned>(static_cast<unsigned char>(c)));
      out += code.data();
    } else {
      out += c;
    }
  }
  return out + "\"";
}

void JsonPrinter::separate() {
  text_ += first_ ? "" : ",";
  first_ = false;
  text_ += closing_.empty() ? "\n  " : (text_.back() == ',' ? " " : "");
}

void JsonPrinter::member(std::string_view key, const std::string& value) {
  separate();
  text_ += json_string(key) + ": " + value;
}

void JsonPrinter::field(std::string_view key, double& value) { member(key, json_number(value)); }
void JsonPrinter::field(std::string_view key, int& value) { member(key, std::to_string(value)); }
void JsonPrinter::field(std::string_view key, std::uint64_t& value) { member(key, std::to_string(value)); }
void JsonPrinter::field(std::string_view key, bool& value) { member(key, value ? "true" : "false"); }
void JsonPrinter::field(std::string_view key, std::string& value) { member(key, json_string(value)); }

void JsonPrinter::field(std::string_view key, std::vector<double>& value) {
  std::string text;
  for (const double item : value) {
    text += (text.empty() ? "" : ", ") + json_number(item);
  }
  member(key, "[" + text + "]");
}

void JsonPrinter::field(std::string_view key, std::vector<std::string>& value) {
  std::string text;
  for (const std::string& item : value) {
    text += (text.empty() ? "" : ", ") + json_string(item);
  }
  member(key, "[" + text + "]");
}

void JsonPrinter::field(std::string_view key, Point2& value) {
  member(key, "[" + json_number(value.x()) + ", " + json_number(value.y()) + "]");
}

void JsonPrinter::field(std::string_view key, Polygon& value) {
  std::string text;
  for (const Point2& corner : value) {
    text += (text.empty() ? "[" : ", [") + json_number(corner.x()) + ", " + json_number(corner.y()) + "]";
  }
  member(key, "[" + text + "]");
}

void JsonPrinter::field(std::string_view key, Pose2& value) {
  member(key, "[" + json_number(value.x_m) + ", " + json_number(value.y_m) + ", " +
                  json_number(rad_to_deg(value.theta_rad)) + "]");
}

bool JsonPrinter::enter(std::string_view key) {
  member(key, "{");
  closing_ += '}';
  first_ = true;
  return true;
}

std::optional<std::size_t> JsonPrinter::enter_list(std::string_view key, std::size_t size) {
  member(key, "[");
  closing_ += ']';
  first_ = true;
  return size;
}

void JsonPrinter::enter_item(std::size_t /*index*/) {
  separate();
  text_ += '{';
  closing_ += '}';
  first_ = true;
}

void JsonPrinter::leave() {
  text_ += closing_.back();
  closing_.pop_back();
  first_ = false;
}

}  // namespace seeker::lab
