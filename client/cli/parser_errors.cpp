#include "client/cli/parser_errors.hpp"

#include <algorithm>
#include <cctype>

#include <CLI/CLI.hpp>

namespace seeker::cli {

std::optional<std::string> unknown_verb(const CLI::App& app, const std::vector<std::string>& arguments) {
  for (auto word = arguments.begin(); word != arguments.end(); ++word) {
    if (!word->starts_with('-')) {
      const bool known = !app.get_subcommands([&](const CLI::App* sub) { return sub->get_name() == *word; }).empty();
      return known ? std::nullopt : std::optional<std::string>(*word);
    }
    const std::size_t equals = word->find('=');
    const CLI::Option* option = app.get_option_no_throw(word->substr(0, equals));
    if (option == nullptr || option == app.get_help_ptr() || option == app.get_version_ptr()) {
      return std::nullopt;
    }
    if (option->get_items_expected_max() != 0 && equals == std::string::npos && std::next(word) != arguments.end()) {
      ++word;
    }
  }
  return std::nullopt;
}

std::string sentence_of(const CLI::App& app, const CLI::ParseError& error) {
  std::string text = error.what();
  std::replace(text.begin(), text.end(), '\n', ' ');
  if (text.size() > 1 && std::isupper(static_cast<unsigned char>(text[1])) == 0) {
    text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  }
  std::string words = "seeker";
  for (const CLI::App* verb = &app; !verb->get_subcommands().empty();) {
    verb = verb->get_subcommands().front();
    words += " " + verb->get_name();
  }
  return text + "; see " + words + " --help";
}

}  // namespace seeker::cli
