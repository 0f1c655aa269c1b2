#include "server/emulator/fault_command.hpp"

#include <cmath>
#include <locale>
#include <optional>
#include <sstream>
#include <vector>

namespace seeker::emulator {
namespace {

std::optional<double> number_in(const std::string& word) {
  std::istringstream in(word);
  in.imbue(std::locale::classic());
  double number = 0.0;
  constexpr double kLargest = 1e9;
  return in >> number && in.eof() && std::isfinite(number) && number >= 0.0 && number <= kLargest
             ? std::optional(number)
             : std::nullopt;
}

tl::unexpected<Error> malformed(std::string_view text) {
  return fail(Errc::kInvalidArgument, "'" + std::string(text) + "' is no fault; write AT_S DEVICE FAULT [VALUE] " +
                                          "[for SECONDS], such as '20 lms200 unplug for 2'");
}

}  // namespace

Result<FaultCommand> parse_fault_command(std::string_view text) {
  std::istringstream in{std::string(text)};
  std::vector<std::string> words;
  for (std::string word; in >> word;) {
    words.push_back(word);
  }
  FaultCommand command;
  constexpr std::size_t kNeeded = 3;
  if (words.size() > kNeeded + 1 && words[words.size() - 2] == "for") {
    const std::optional<double> for_s = number_in(words.back());
    if (!for_s) {
      return malformed(text);
    }
    command.duration = seconds(*for_s);
    words.resize(words.size() - 2);
  }
  const std::optional<double> at_s = words.empty() ? std::nullopt : number_in(words.front());
  const std::optional<double> value = words.size() == kNeeded + 1 ? number_in(words.back()) : std::optional(0.0);
  if (!at_s || !value || words.size() < kNeeded || words.size() > kNeeded + 1) {
    return malformed(text);
  }
  command.at = robot_time_s(*at_s);
  command.device = words[1];
  command.fault = words[2];
  command.value = *value;
  return command;
}

}  // namespace seeker::emulator
