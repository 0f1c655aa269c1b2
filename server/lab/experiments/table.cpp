#include "server/lab/experiments/table.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

namespace seeker::lab {
namespace {

constexpr std::size_t kTextColumns = 2;

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) {
    return text;
  }
  std::string quoted = "\"";
  for (const char c : text) {
    quoted += c == '"' ? "\"\"" : std::string(1, c);
  }
  return quoted + "\"";
}

}  // namespace

std::string Table::csv() const {
  std::string text;
  for (const std::vector<std::string>& row : rows_) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      text += (i == 0 ? "" : ",") + csv_field(row[i]);
    }
    text += '\n';
  }
  return text;
}

std::string Table::markdown() const {
  std::string text;
  for (const std::vector<std::string>& row : rows_) {
    for (const std::string& cell : row) {
      text += "| " + cell + " ";
    }
    text += "|\n";
    if (&row == &rows_.front()) {
      for (std::size_t i = 0; i < row.size(); ++i) {
        text += "| --- ";
      }
      text += "|\n";
    }
  }
  return text;
}

std::string Table::text() const {
  std::vector<std::size_t> widths(rows_.front().size(), 0);
  for (const std::vector<std::string>& row : rows_) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      widths[i] = std::max(widths[i], row[i].size());
    }
  }
  std::string text;
  for (const std::vector<std::string>& row : rows_) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string pad(widths[i] - row[i].size(), ' ');
      text += (i == 0 ? "" : "  ") + (i < kTextColumns ? row[i] + pad : pad + row[i]);
    }
    text.erase(text.find_last_not_of(' ') + 1);
    text += '\n';
  }
  return text;
}

std::string fixed(double value, int digits) {
  std::array<char, 64> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.*f", digits, value);
  return buffer.data();
}

}  // namespace seeker::lab
