/// \file
/// What the --help of a program or of a verb offers, and whether a command keeps to it.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tests/docs/command.hpp"

namespace seeker::docs {

struct HelpOption {
  bool takes_value = false;
  std::set<std::string> choices;  ///< empty: any value
};

struct Help {
  std::set<std::string> verbs;
  std::map<std::string, HelpOption> options;  ///< by each of its names, e.g. -q and --quiet
  std::vector<HelpOption> positionals;
};

/// A help text in the form that CLI11 gives it.
[[nodiscard]] Help parse_help(std::string_view text);

/// The help of a verb, by the words that lead to it; nothing where the program refuses them.
using HelpSource = std::function<std::optional<Help>(const std::vector<std::string>& verb)>;

/// What is wrong with a command of a program: an unknown verb, option or choice. Empty: nothing. An option may be the
/// verb's own or one of those above it. `verb` gets the words that led to the verb.
[[nodiscard]] std::string check_command(const Command& command, const HelpSource& help,
                                        std::vector<std::string>* verb = nullptr);

}  // namespace seeker::docs
