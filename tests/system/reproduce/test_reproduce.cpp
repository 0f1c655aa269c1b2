/// The smallest form of every reproduction of a paper: what `seeker-lab reproduce NAME --smallest` prints must all
/// pass, so that none breaks unseen.
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "server/lab/command/commands.hpp"
#include "tests/support/data.hpp"

namespace seeker::lab {
namespace {

struct Answer {
  int code = 0;
  std::string out;
};

Answer reproduce(const std::string& name) {
  const std::filesystem::path out = std::filesystem::path(::testing::TempDir()) / ("reproduce-" + name);
  std::filesystem::remove_all(out);
  std::vector<std::string> words = {"seeker-lab", "reproduce",  name,       "--smallest",
                                    "--out",      out.string(), "--config", testing::source_file("config").string()};
  std::vector<char*> arguments;
  for (std::string& word : words) {
    arguments.push_back(word.data());
  }
  ::testing::internal::CaptureStdout();
  Answer answer;
  answer.code = run_lab(static_cast<int>(arguments.size()), arguments.data());
  answer.out = ::testing::internal::GetCapturedStdout();
  return answer;
}

class Reproduce : public ::testing::TestWithParam<const char*> {};

TEST_P(Reproduce, PassesInItsSmallestForm) {
  const Answer answer = reproduce(GetParam());
  EXPECT_EQ(answer.code, 0) << answer.out;
  EXPECT_NE(answer.out.find("PASS "), std::string::npos) << "nothing was checked";
  EXPECT_EQ(answer.out.find("FAIL "), std::string::npos) << answer.out;
}

INSTANTIATE_TEST_SUITE_P(Papers, Reproduce,
                         ::testing::Values("active-slam", "consistency", "efficiency", "efficiency-fleet",
                                           "line-detection", "map-merging", "search", "solids", "stereo-database"),
                         [](const auto& reproduction) {
                           std::string name = reproduction.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace seeker::lab
