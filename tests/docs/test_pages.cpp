/// \file
/// The pages of the project keep to their limits, and what they name is there.
#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <regex>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/docs/help.hpp"
#include "tests/docs/page.hpp"
#include "tests/docs/source_path.hpp"
#include "tests/support/data.hpp"
#include "tests/support/findings.hpp"
#include "tests/support/process.hpp"

namespace seeker::docs {
namespace {

namespace fs = std::filesystem;
using ::testing::IsEmpty;
using testing::joined;

constexpr std::size_t kColumns = 120;
const std::map<std::string, std::size_t> kMostLines = {
    {"docs/results.md", 200}, {"docs/architecture.md", 200}, {"docs/algorithms.md", 200}};

Page read_page(const std::string& path) {
  std::ifstream in(testing::source_file(path), std::ios::binary);
  EXPECT_TRUE(in) << path;
  return parse_page(path, std::string{std::istreambuf_iterator<char>(in), {}});
}

const std::vector<Page>& pages() {
  static const std::vector<Page> all = [] {
    std::vector<Page> read{read_page("README.md")};
    for (const fs::directory_entry& entry : fs::directory_iterator(testing::source_file("docs"))) {
      if (entry.path().extension() == ".md") {
        read.push_back(read_page("docs/" + entry.path().filename().string()));
      }
    }
    return read;
  }();
  return all;
}

std::string place(const Page& page, std::size_t line) { return page.path + ":" + std::to_string(line) + ": "; }

struct Answer {
  int code = 0;
  std::string text;
};

/// What a program prints for these words and --help; each is asked once.
const Answer& help_text(const std::string& program, const std::vector<std::string>& verb) {
  static std::map<std::pair<std::string, std::vector<std::string>>, Answer> known;
  const auto [entry, is_new] = known.try_emplace({program, verb});
  if (is_new) {
    static const fs::path folder = testing::fresh_folder("docs");
    const fs::path file = program == "run" ? testing::source_file("run") : testing::program(program);
    std::vector<std::string> words = verb;
    words.emplace_back("--help");
    testing::ChildProcess process(file, words, folder / std::to_string(known.size()));
    entry->second.code = process.wait(std::chrono::seconds(20)).value_or(-1);
    entry->second.text = process.output();
  }
  return entry->second;
}

HelpSource help_of(const std::string& program) {
  return [program](const std::vector<std::string>& verb) -> std::optional<Help> {
    const Answer& answer = help_text(program, verb);
    return answer.code == 0 ? std::optional(parse_help(answer.text)) : std::nullopt;
  };
}

std::set<std::string> options_named_in(const std::string& text) {
  static const std::regex option("--[a-z][a-z-]*");
  return {std::sregex_token_iterator(text.begin(), text.end(), option), std::sregex_token_iterator()};
}

/// What is wrong with the words behind `./run bench NAME` and `./run fuzz NAME`.
std::string check_run_target(const std::string& verb, const std::string& word) {
  const bool is_there = verb == "bench"  ? fs::exists(testing::source_file("tests/bench/bench_" + word + ".cpp"))
                        : verb == "fuzz" ? fs::exists(testing::source_file("tests/fuzz/fuzz_" + word + ".cpp"))
                                         : true;
  return is_there ? "" : "there is no '" + word + "'";
}

/// `./run` has no help in the form of CLI11: an option is known when the text names it.
std::string check_run(const Command& command) {
  if (command.words.empty() || is_placeholder(command.words.front())) {
    return "";
  }
  const std::string& verb = command.words.front();
  std::vector<std::string> path{verb};
  const std::set<std::string> with_help_of_their_own{"peers", "hardware", "link"};
  if (verb == "bench" && command.words.size() > 1 && with_help_of_their_own.contains(command.words[1])) {
    path.push_back(command.words[1]);
  }
  if (verb == "reproduce") {  // what is not its own goes to seeker-lab
    std::vector<std::string> words{"reproduce"};
    std::copy_if(std::next(command.words.begin()), command.words.end(), std::back_inserter(words),
                 [](const std::string& word) { return word != "--help"; });
    return check_command({"seeker-lab", words}, help_of("seeker-lab"));
  }
  const Answer& help = help_text("run", path);
  if (help.code != 0) {
    return "there is no verb '" + verb + "'";
  }
  std::set<std::string> known = options_named_in(help.text);
  known.insert("--help");
  for (std::size_t i = path.size(); i < command.words.size(); ++i) {
    const std::string& word = command.words[i];
    if (word.starts_with("--") ? !known.contains(word) : false) {
      return "there is no option " + word;
    }
    const bool is_target = path.size() == 1 && !word.starts_with('-') && !command.words[i - 1].starts_with('-');
    if (std::string wrong = is_target ? check_run_target(verb, word) : ""; !wrong.empty()) {
      return wrong;
    }
  }
  return "";
}

std::vector<std::string> wrong_commands(const Page& page) {
  std::vector<std::string> findings;
  for (const Piece& code : page.code) {
    for (const Command& command : commands_in(code.text)) {
      const std::string wrong =
          command.program == "run" ? check_run(command) : check_command(command, help_of(command.program));
      if (!wrong.empty()) {
        findings.push_back(place(page, code.line) + wrong + " in: " + code.text);
      }
    }
  }
  return findings;
}

/// All verbs that have no further ones, by their words.
std::vector<std::vector<std::string>> verbs_of(const HelpSource& source, const std::vector<std::string>& verb = {}) {
  const std::optional<Help> help = source(verb);
  if (!help || help->verbs.empty()) {
    return {verb};
  }
  std::vector<std::vector<std::string>> all;
  for (const std::string& word : help->verbs) {
    std::vector<std::string> deeper = verb;
    deeper.push_back(word);
    const auto found = verbs_of(source, deeper);
    all.insert(all.end(), found.begin(), found.end());
  }
  return all;
}

TEST(Documents, LinesAndPagesHaveTheirLimits) {
  ASSERT_GT(pages().size(), 5U) << "the pages were not found";
  std::vector<std::string> findings;
  for (const Page& page : pages()) {
    for (std::size_t i = 0; i < page.lines.size(); ++i) {
      if (columns(page.lines[i]) > kColumns) {
        findings.push_back(place(page, i + 1) + std::to_string(columns(page.lines[i])) + " columns");
      }
    }
    if (const auto most = kMostLines.find(page.path); most != kMostLines.end() && page.lines.size() > most->second) {
      findings.push_back(page.path + ": " + std::to_string(page.lines.size()) + " lines");
    }
  }
  EXPECT_THAT(findings, IsEmpty()) << joined(findings);
}

TEST(Documents, EveryCommandIsOneThatTheProgramsHave) {
  std::vector<std::string> findings;
  std::size_t commands = 0;
  for (const Page& page : pages()) {
    const std::vector<std::string> wrong = wrong_commands(page);
    findings.insert(findings.end(), wrong.begin(), wrong.end());
    commands += static_cast<std::size_t>(std::count_if(
        page.code.begin(), page.code.end(), [](const Piece& code) { return !commands_in(code.text).empty(); }));
  }
  EXPECT_GT(commands, 50U) << "the commands were not found";
  EXPECT_THAT(findings, IsEmpty()) << joined(findings);
}

TEST(Documents, EveryVerbOfTheClientIsOnItsPage) {
  std::set<std::vector<std::string>> described;
  for (const Piece& code : read_page("docs/client.md").code) {
    for (const Command& command : commands_in(code.text)) {
      std::vector<std::string> verb;
      if (command.program == "seeker" && check_command(command, help_of("seeker"), &verb).empty()) {
        described.insert(verb);
      }
    }
  }
  for (const std::vector<std::string>& verb : verbs_of(help_of("seeker"))) {
    EXPECT_TRUE(described.contains(verb)) << joined(verb) << "is not in docs/client.md";
  }
}

TEST(Documents, EveryPathOfTheTreeExists) {
  std::vector<std::string> findings;
  for (const Page& page : pages()) {
    for (const Piece& code : page.code) {
      for (const std::string& path : source_paths_in(code.text)) {
        if (!exists_in_tree(testing::source_file(""), path)) {
          findings.push_back(place(page, code.line) + path);
        }
      }
    }
  }
  EXPECT_THAT(findings, IsEmpty()) << joined(findings);
}

TEST(Documents, EveryLinkLeadsSomewhere) {
  const auto anchors = [](const std::string& path) {
    const auto page = std::find_if(pages().begin(), pages().end(), [&](const Page& p) { return p.path == path; });
    return page == pages().end() ? std::set<std::string>() : page->anchors;
  };
  for (const Page& page : pages()) {
    for (const Piece& link : page.links) {
      if (link.text.find("://") != std::string::npos) {
        continue;
      }
      const std::size_t hash = link.text.find('#');
      const std::string file = link.text.substr(0, hash);
      const std::string path =
          file.empty() ? page.path : (fs::path(page.path).parent_path() / file).lexically_normal().generic_string();
      EXPECT_TRUE(fs::exists(testing::source_file(path))) << place(page, link.line) << link.text;
      if (hash != std::string::npos) {
        EXPECT_TRUE(anchors(path).contains(link.text.substr(hash + 1))) << place(page, link.line) << link.text;
      }
    }
  }
}

}  // namespace
}  // namespace seeker::docs
