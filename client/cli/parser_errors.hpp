/// \file
/// Wrong command lines in sentences of ours.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): the name that CLI11 has
class App;
class ParseError;
}  // namespace CLI

namespace seeker::cli {

/// The first word, when it is no verb; CLI11 would only say that one is missing. Options before it are passed over with
/// their values.
[[nodiscard]] std::optional<std::string> unknown_verb(const CLI::App& app, const std::vector<std::string>& arguments);

/// What CLI11 says as one sentence, with where to read on.
[[nodiscard]] std::string sentence_of(const CLI::App& app, const CLI::ParseError& error);

}  // namespace seeker::cli
