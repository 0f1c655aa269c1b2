#include "server/lab/experiments/check.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "server/lab/experiments/described_json.hpp"

namespace seeker::lab {

std::string verdict_of(const Check& check) {
  if (check.passed) {
    return "PASS";
  }
  return check.finding ? "FINDING" : "FAIL";
}

std::string line_of(const Check& check) {
  std::string line = verdict_of(check) + " " + check.id;
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
  return std::all_of(checks_.begin(), checks_.end(), [](const Check& check) { return check.passed || check.finding; });
}

std::string Report::json() const {
  auto list = nlohmann::ordered_json::array();
  for (const Check& check : checks_) {
    nlohmann::ordered_json& row = list.emplace_back();
    row["id"] = check.id;
    row["passed"] = check.passed;
    row["verdict"] = verdict_of(check);
    for (const auto& [name, value] : check.figures) {
      row[name] = value;
    }
  }
  return json_lines(list);
}

}  // namespace seeker::lab
