#include <array>
#include <charconv>

#include "common/config/yaml.hpp"
#include "common/core/angle.hpp"

namespace seeker::config {
namespace {

/// Shortest text that reads back as the same double.
std::string number(double value) {
  std::array<char, 32> buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), result.ptr};
}

std::string in_quotes(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
    }
    out += c;
  }
  return out + "\"";
}

std::string corner(const Point2& p) { return "[" + number(p.x()) + ", " + number(p.y()) + "]"; }

}  // namespace

void TextFields::field(std::string_view key, double& value) { line(key, number(value)); }
void TextFields::field(std::string_view key, int& value) { line(key, std::to_string(value)); }
void TextFields::field(std::string_view key, std::uint64_t& value) { line(key, std::to_string(value)); }
void TextFields::field(std::string_view key, bool& value) { line(key, value ? "true" : "false"); }
void TextFields::field(std::string_view key, std::string& value) { line(key, in_quotes(value)); }
void TextFields::field(std::string_view key, Point2& value) { line(key, corner(value)); }
void TextFields::field(std::string_view key, Pose2& value) {
  line(key, "[" + number(value.x_m) + ", " + number(value.y_m) + ", " + number(rad_to_deg(value.theta_rad)) + "]");
}

void TextFields::field(std::string_view key, std::vector<double>& value) {
  std::string text;
  for (const double item : value) {
    text += (text.empty() ? "" : ", ") + number(item);
  }
  line(key, "[" + text + "]");
}

void TextFields::field(std::string_view key, std::vector<std::string>& value) {
  std::string text;
  for (const std::string& item : value) {
    text += (text.empty() ? "" : ", ") + in_quotes(item);
  }
  line(key, "[" + text + "]");
}

void TextFields::field(std::string_view key, Polygon& value) {
  std::string text;
  for (const Point2& p : value) {
    text += (text.empty() ? "" : ", ") + corner(p);
  }
  line(key, "[" + text + "]");
}

void Printer::line(std::string_view key, const std::string& value) {
  constexpr std::size_t kIndent = 2;
  std::string indent(static_cast<std::size_t>(depth_) * kIndent, ' ');
  if (item_start_) {
    indent[indent.size() - kIndent] = '-';
    item_start_ = false;
  }
  text_ += indent + std::string(key) + ":" + (value.empty() ? "" : " " + value) + "\n";
}

bool Printer::enter(std::string_view key) {
  line(key, "");
  ++depth_;
  return true;
}

std::optional<std::size_t> Printer::enter_list(std::string_view key, std::size_t size) {
  line(key, size == 0 ? "[]" : "");
  ++depth_;
  return size;
}

void Printer::enter_item(std::size_t /*index*/) {
  ++depth_;
  item_start_ = true;
}

void Printer::leave() { --depth_; }

bool LeafCollector::enter(std::string_view key) {
  sections_.emplace_back(key);
  return true;
}

void LeafCollector::leave() { sections_.pop_back(); }

void LeafCollector::line(std::string_view key, const std::string& value) {
  std::string path;
  for (const std::string& section : sections_) {
    path += section + ".";
  }
  leaves_.push_back({path + std::string(key), value});
}

}  // namespace seeker::config
