#include "server/lab/experiments/check.hpp"

#include <algorithm>

#include "server/lab/experiments/json_printer.hpp"

namespace seeker::lab {

std::string line_of(const Check& check) {
  std::string line = (check.passed ? "PASS " : "FAIL ") + check.id;
  for (const auto& [name, value] : check.figures) {
    line.append(" ").append(name).append("=").append(value);
  }
  return line;
}

void Report::add(Check check) {
  if (out_ != nullptr) {
    *out_ << line_of(check) << std::endl;
  }
  checks_.push_back(std::move(check));
}

bool Report::passed() const {
  return std::all_of(checks_.begin(), checks_.end(), [](const Check& check) { return check.passed; });
}

std::string Report::json() const {
  std::string text = "[";
  for (const Check& check : checks_) {
    text += text.size() > 1 ? ",\n " : "\n ";
    text += "{\"id\": " + json_string(check.id) + ", \"passed\": " + (check.passed ? "true" : "false");
    for (const auto& [name, value] : check.figures) {
      text += ", " + json_string(name) + ": " + json_string(value);
    }
    text += "}";
  }
  return text + "\n]\n";
}

}  // namespace seeker::lab
