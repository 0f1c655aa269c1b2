/// \file
/// Error messages for wrong command lines.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): the name that CLI11 has
class App;
class ParseError;
}  // namespace CLI

namespace seeker::cli {

/// The first argument that is no option or value of one, when it is no verb: CLI11 would only report that a verb is
/// missing.
[[nodiscard]] std::optional<std::string> unknown_verb(const CLI::App& app, const std::vector<std::string>& arguments);

/// The error of CLI11 as one sentence that refers to the help.
[[nodiscard]] std::string sentence_of(const CLI::App& app, const CLI::ParseError& error);

}  // namespace seeker::cli
