/// \file
/// The source tree follows layers.txt.
#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/arch/rules.hpp"
#include "tests/support/data.hpp"
#include "tests/support/findings.hpp"

namespace seeker::arch {
namespace {

namespace fs = std::filesystem;
using ::testing::IsEmpty;
using testing::joined;

std::string read(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  EXPECT_TRUE(in) << file;
  return {std::istreambuf_iterator<char>(in), {}};
}

Layers table() {
  Result<Layers> layers = parse_layers(read(testing::source_file("tests/arch/layers.txt")));
  if (!layers) {
    ADD_FAILURE() << "tests/arch/layers.txt: " << layers.error().message;
    return {};
  }
  return std::move(*layers);
}

/// Files below common, server and client for which `wanted` is true, sorted by path.
template <class Wanted>
std::vector<SourceFile> files_of_tree(Wanted wanted) {
  std::vector<SourceFile> files;
  const fs::path top = testing::source_file("");
  for (const char* folder : {"common", "server", "client"}) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(top / folder)) {
      if (entry.is_regular_file() && wanted(entry.path())) {
        files.push_back({entry.path().lexically_relative(top).generic_string(), read(entry.path())});
      }
    }
  }
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.path < b.path; });
  return files;
}

TEST(Architecture, EveryIncludeIsInTheTable) {
  const Layers layers = table();
  const auto files =
      files_of_tree([](const fs::path& p) { return p.extension() == ".cpp" || p.extension() == ".hpp"; });
  ASSERT_GT(files.size(), 20U) << "the sources were not found";
  std::vector<std::string> findings;
  for (const SourceFile& file : files) {
    const auto found = check_source(layers, file);
    findings.insert(findings.end(), found.begin(), found.end());
  }
  EXPECT_THAT(findings, IsEmpty()) << joined(findings);
}

TEST(Architecture, EveryFolderOfTheTableIsThere) {
  std::vector<std::string> findings;
  const Layers layers = table();
  for (const auto& [folder, may_include] : layers.folders) {
    if (!fs::is_directory(testing::source_file(folder))) {
      findings.push_back("tests/arch/layers.txt: folder '" + folder + "' does not exist");
    }
  }
  EXPECT_THAT(findings, IsEmpty()) << joined(findings);
}

TEST(Architecture, EveryTargetIsInTheTable) {
  const auto lists = files_of_tree([](const fs::path& p) { return p.filename() == "CMakeLists.txt"; });
  ASSERT_GT(lists.size(), 10U) << "the CMakeLists.txt files were not found";
  const auto findings = check_targets(table(), lists);
  EXPECT_THAT(findings, IsEmpty()) << joined(findings);
}

}  // namespace
}  // namespace seeker::arch
