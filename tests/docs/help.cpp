#include "tests/docs/help.hpp"

#include <algorithm>
#include <cctype>
#include <regex>
#include <sstream>
#include <utility>

namespace seeker::docs {
namespace {

std::set<std::string> split(const std::string& text) {
  std::set<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, ',');) {
    parts.insert(part);
  }
  return parts;
}

void take_option(const std::string& line, Help& help) {
  static const std::regex form(R"(^  ((?:-\w,)?--[\w-]+|-\w)(?: (?:TEXT|FLOAT|U?INT)(:\{([^}]*)\})?)?)");
  static const std::regex with_type(R"(^  \S+ (?:TEXT|FLOAT|U?INT)\b)");
  std::smatch match;
  if (std::regex_search(line, match, form)) {
    const HelpOption option{.takes_value = std::regex_search(line, with_type), .choices = split(match[3].str())};
    for (const std::string& name : split(match[1].str())) {
      help.options[name] = option;
    }
  }
}

void take_positional(const std::string& line, Help& help) {
  static const std::regex form(R"(^  \w+ (?:TEXT|FLOAT|U?INT)(?::\{([^}]*)\})?)");
  std::smatch match;
  if (std::regex_search(line, match, form)) {
    help.positionals.push_back({.takes_value = true, .choices = split(match[1].str())});
  }
}

void take_verb(const std::string& line, Help& help) {
  static const std::regex form(R"(^  ([a-z][\w-]*)(?: |$))");
  std::smatch match;
  if (std::regex_search(line, match, form)) {
    help.verbs.insert(match[1].str());
  }
}

std::string check_value(const std::string& word, const HelpOption& option) {
  if (option.choices.empty()) {
    return "";
  }
  for (const std::string& value : split(word)) {
    if (!is_placeholder(value) && !option.choices.contains(value)) {
      return "'" + value + "' is none of the choices";
    }
  }
  return "";
}

/// Follows the words of one command.
class Walk {
 public:
  explicit Walk(const HelpSource& source) : source_(source) { enter({}); }

  [[nodiscard]] std::string take(const std::string& word) {
    if (helps_.empty()) {
      return "no --help";
    }
    if (const HelpOption* waiting = std::exchange(waiting_, nullptr); waiting != nullptr && !word.starts_with("--")) {
      return check_value(word, *waiting);
    }
    if (is_option(word)) {
      return take_option(word);
    }
    return helps_.back().verbs.empty() ? take_positional(word) : take_verb(word);
  }

  [[nodiscard]] const std::vector<std::string>& verb() const { return verb_; }

 private:
  static bool is_option(std::string_view word) {
    return word.size() > 1 && word.front() == '-' &&
           (word[1] == '-' || std::isalpha(static_cast<unsigned char>(word[1])) != 0);
  }

  bool enter(const std::vector<std::string>& verb) {
    std::optional<Help> help = source_(verb);
    if (!help) {
      return false;
    }
    helps_.push_back(std::move(*help));
    verb_ = verb;
    return true;
  }

  std::string take_option(const std::string& word) {
    const std::string name = word.substr(0, word.find('='));
    for (const Help& help : helps_) {
      if (const auto found = help.options.find(name); found != help.options.end()) {
        waiting_ = found->second.takes_value && name == word ? &found->second : nullptr;
        return name == word ? "" : check_value(word.substr(name.size() + 1), found->second);
      }
    }
    return "there is no option " + name;
  }

  std::string take_verb(const std::string& word) {
    if (is_placeholder(word)) {
      return "";
    }
    std::vector<std::string> deeper = verb_;
    deeper.push_back(word);
    return helps_.back().verbs.contains(word) && enter(deeper) ? "" : "there is no verb '" + word + "'";
  }

  std::string take_positional(const std::string& word) {
    const std::vector<HelpOption>& all = helps_.back().positionals;
    if (is_placeholder(word) || all.empty()) {
      return is_placeholder(word) ? "" : "'" + word + "' is no argument of it";
    }
    return check_value(word, all[std::min(positional_++, all.size() - 1)]);
  }

  const HelpSource& source_;
  std::vector<Help> helps_;  ///< of the program, then of its verb, ...
  std::vector<std::string> verb_;
  const HelpOption* waiting_ = nullptr;  ///< the option whose value comes next
  std::size_t positional_ = 0;
};

}  // namespace

Help parse_help(std::string_view text) {
  Help help;
  std::istringstream in{std::string(text)};
  std::string section;
  for (std::string line; std::getline(in, line);) {
    if (line == "Options:" || line == "Positionals:" || line == "Subcommands:") {
      section = line;
    } else if (!line.starts_with(' ')) {
      section.clear();
    } else if (section == "Options:") {
      take_option(line, help);
    } else if (section == "Positionals:") {
      take_positional(line, help);
    } else if (section == "Subcommands:") {
      take_verb(line, help);
    }
  }
  return help;
}

std::string check_command(const Command& command, const HelpSource& help, std::vector<std::string>* verb) {
  Walk walk(help);
  for (const std::string& word : command.words) {
    if (std::string wrong = walk.take(word); !wrong.empty()) {
      return wrong;
    }
  }
  if (verb != nullptr) {
    *verb = walk.verb();
  }
  return "";
}

}  // namespace seeker::docs
