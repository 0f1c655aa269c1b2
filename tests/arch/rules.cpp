#include "tests/arch/rules.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <regex>
#include <sstream>
#include <string_view>

namespace seeker::arch {
namespace {

/// Headers of C++ that an algorithm has no business with.
constexpr std::array<std::string_view, 15> kImpureHeaders{
    "thread",  "mutex",    "shared_mutex", "condition_variable", "future", "semaphore",  "latch",  "barrier",
    "fstream", "iostream", "filesystem",   "stop_token",         "ctime",  "syncstream", "csignal"};

struct Include {
  std::string header;
  bool quoted = false;
};

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

std::optional<Include> include_of(const std::string& line) {
  static const std::regex pattern(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
  std::smatch match;
  if (!std::regex_search(line, match, pattern)) {
    return std::nullopt;
  }
  return Include{match[2], match[1] == "\""};
}

/// <vector>, <cmath>, <unistd.h> is not one.
bool is_cxx_header(const std::string& header) { return header.find_first_of("/.") == std::string::npos; }

/// Everything a check of one file needs.
class FileCheck {
 public:
  FileCheck(const Layers& layers, const SourceFile& file)
      : layers_(layers), file_(file), folder_(layers.folder_of(file.path)) {}

  std::vector<std::string> run() {
    if (folder_.empty()) {
      report("lies in no folder of tests/arch/layers.txt; add the folder with what it may include");
      return std::move(findings_);
    }
    std::istringstream in(file_.text);
    for (std::string text; std::getline(in, text);) {
      ++line_;
      if (const auto include = include_of(text)) {
        check_include(*include);
      }
      check_clock(text);
    }
    if (ends_with(file_.path, "/main.cpp") && line_ > kMaxMainLines) {
      report("main has " + std::to_string(line_) + " lines; move work into the folder's library (limit " +
             std::to_string(kMaxMainLines) + ")");
    }
    return std::move(findings_);
  }

 private:
  void report(const std::string& sentence) {
    findings_.push_back(file_.path + ":" + std::to_string(line_) + ": " + sentence);
  }

  void check_include(const Include& include) {
    const std::string& header = include.header;
    if (ends_with(header, ".pb.h") && layers_.library_of(header).empty()) {
      check_folder("proto", header);
    } else if (include.quoted) {
      const std::string target = layers_.folder_of(header);
      target.empty() ? report("includes \"" + header +
                              "\", which is in no folder of tests/arch/layers.txt; own headers "
                              "are included by their path from the top")
                     : check_folder(target, header);
    } else if (is_cxx_header(header)) {
      check_cxx(header);
    } else {
      check_library(header);
    }
  }

  void check_folder(const std::string& target, const std::string& header) {
    const Folder& rule = layers_.folders.at(folder_);
    if (target != folder_ && !rule.folders.contains(target)) {
      report("includes " + header + ", but " + folder_ + " may not include " + target);
    }
  }

  void check_cxx(const std::string& header) {
    const bool impure = std::find(kImpureHeaders.begin(), kImpureHeaders.end(), header) != kImpureHeaders.end();
    if (impure && layers_.pure.contains(folder_)) {
      report("includes <" + header + ">, but " + folder_ + " is a folder of algorithms: values in, values out");
    }
  }

  void check_library(const std::string& header) {
    const std::string library = layers_.library_of(header);
    const Folder& rule = layers_.folders.at(folder_);
    if (library.empty()) {
      report("includes <" + header + ">, a library that is not in tests/arch/layers.txt");
    } else if (!rule.libraries.contains(library) && !rule.libraries.contains("*") &&
               !layers_.everywhere.contains(library)) {
      report("includes <" + header + ">, but " + folder_ + " may not use " + library);
    } else if (layers_.hidden.contains(library) && ends_with(file_.path, ".hpp")) {
      report("includes <" + header + "> in a header; " + library + " belongs into .cpp files");
    }
  }

  void check_clock(const std::string& text) {
    static const std::regex pattern(R"((_clock::now|random_device|\bstd::rand\b|\bgettimeofday\b)\s*[({ ]?)");
    const std::string code = text.substr(0, text.find("//"));
    if (layers_.pure.contains(folder_) && std::regex_search(code, pattern)) {
      report("reads a clock or a source of chance, but " + folder_ + " gets RobotTime and Rng& as arguments");
    }
  }

  const Layers& layers_;
  const SourceFile& file_;
  std::string folder_;
  int line_ = 0;
  std::vector<std::string> findings_;
};

struct Target {
  std::string name;    ///< "seeker_nav"
  std::string folder;  ///< "server/nav"
  std::vector<std::string> dependencies;
};

std::vector<Target> libraries_in(const SourceFile& list) {
  static const std::regex pattern(R"(seeker_(library|program)\s*\(\s*([^)]*)\))");
  const std::string folder = list.path.substr(0, list.path.rfind('/'));
  std::vector<Target> targets;
  for (std::sregex_iterator it(list.text.begin(), list.text.end(), pattern), end; it != end; ++it) {
    std::istringstream in((*it)[2]);
    Target target{{}, folder, {}};
    in >> target.name;
    target.name = (*it)[1] == "library" ? "seeker_" + target.name : target.name;
    for (std::string word; in >> word;) {
      target.dependencies.push_back(word);
    }
    targets.push_back(std::move(target));
  }
  return targets;
}

}  // namespace

std::vector<std::string> check_source(const Layers& layers, const SourceFile& file) {
  return FileCheck(layers, file).run();
}

std::vector<std::string> check_targets(const Layers& layers, const std::vector<SourceFile>& cmake_lists) {
  std::vector<Target> targets;
  for (const SourceFile& list : cmake_lists) {
    const auto found = libraries_in(list);
    targets.insert(targets.end(), found.begin(), found.end());
  }
  std::map<std::string, std::string> folder_of_target{{"seeker_proto", "proto"}};
  for (const Target& target : targets) {
    folder_of_target.emplace(target.name, target.folder);
  }
  std::vector<std::string> findings;
  for (const Target& target : targets) {
    const auto rule = layers.folders.find(target.folder);
    if (rule == layers.folders.end()) {
      findings.push_back(target.folder + "/CMakeLists.txt: the folder of " + target.name +
                         " is not in tests/arch/layers.txt");
      continue;
    }
    for (const std::string& dependency : target.dependencies) {
      const auto to = folder_of_target.find(dependency);
      if (to != folder_of_target.end() && to->second != target.folder && !rule->second.folders.contains(to->second)) {
        findings.push_back(target.folder + "/CMakeLists.txt: " + target.name + " links " + dependency + ", but " +
                           target.folder + " may not include " + to->second);
      }
    }
  }
  return findings;
}

}  // namespace seeker::arch
