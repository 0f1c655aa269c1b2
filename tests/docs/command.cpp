#include "tests/docs/command.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <utility>

namespace seeker::docs {
namespace {

constexpr std::array<std::string_view, 4> kPrograms = {"seeker", "seekerd", "seeker-emulator", "seeker-lab"};

/// Words of a shell line: quotes are taken off, a comment ends it.
std::vector<std::string> shell_words(std::string_view code) {
  std::vector<std::string> words;
  std::string word;
  bool in_word = false;
  char quote = '\0';
  const auto finish = [&] {
    if (in_word) {
      words.push_back(std::exchange(word, {}));
      in_word = false;
    }
  };
  for (const char c : code) {
    if (quote != '\0' && c == quote) {
      quote = '\0';
    } else if (quote != '\0') {
      word += c;
    } else if (c == '\'' || c == '"') {
      quote = c;
      in_word = true;
    } else if (c == '#' && !in_word) {
      break;
    } else if (c == ' ' || c == '[' || c == ']') {
      finish();
    } else {
      word += c;
      in_word = true;
    }
  }
  finish();
  return words;
}

std::optional<std::string> program_of(std::string_view word) {
  if (word == "./run") {
    return "run";
  }
  const std::string_view name = word.substr(word.rfind('/') + 1);  // npos + 1 is 0
  if (std::find(kPrograms.begin(), kPrograms.end(), name) == kPrograms.end()) {
    return std::nullopt;
  }
  return std::string(name);
}

bool joins_commands(std::string_view word) { return word == "|" || word == "&&" || word == ";" || word == "&"; }

}  // namespace

std::vector<Command> commands_in(std::string_view code) {
  std::vector<Command> commands;
  bool at_begin = true;
  bool ours = false;
  for (std::string& word : shell_words(code)) {
    if (joins_commands(word)) {
      at_begin = true;
    } else if (at_begin) {
      const std::optional<std::string> program = program_of(word);
      ours = program.has_value();
      if (ours) {
        commands.push_back({*program, {}});
      }
      at_begin = false;
    } else if (ours) {
      commands.back().words.push_back(std::move(word));
    }
  }
  return commands;
}

bool is_placeholder(std::string_view word) {
  return word.starts_with("..") || (!word.empty() && std::isupper(static_cast<unsigned char>(word.front())) != 0);
}

}  // namespace seeker::docs
