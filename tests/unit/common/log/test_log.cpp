#include <vector>

#include <gmock/gmock.h>

#include "common/log/log.hpp"

namespace seeker::log {
namespace {

TEST(Log, LinesForTheJournalBeginWithTheirPriority) {
  EXPECT_EQ(format_line({Level::kError, "net", "broke"}, Format::kJournald), "<3>net: broke");
  EXPECT_EQ(format_line({Level::kInfo, "net", "up"}, Format::kJournald), "<6>net: up");
  EXPECT_EQ(format_line({Level::kWarning, "net", "slow"}, Format::kText), "WARNING net: slow");
}

TEST(Log, ANewlineFromOutsideForgesNoSecondLine) {
  EXPECT_EQ(format_line({Level::kInfo, "net", "a\n<0>b"}, Format::kJournald), "<6>net: a <0>b");
}

TEST(Log, LinesForProgramsAreFieldsOfJson) {
  EXPECT_EQ(format_line({Level::kWarning, "net", "said \"no\"\n"}, Format::kJson),
            R"("level":"WARNING","part":"net","text":"said \"no\"\n")");
  EXPECT_EQ(format_line({Level::kInfo, "net", "\xff"}, Format::kJson),
            "\"level\":\"INFO\",\"part\":\"net\",\"text\":\"\xEF\xBF\xBD\"");
}

TEST(Log, FormatsAreReadByName) {
  EXPECT_EQ(parse_format("json"), Format::kJson);
  EXPECT_EQ(parse_format("text"), Format::kText);
  EXPECT_EQ(parse_format("journald"), Format::kJournald);
  EXPECT_EQ(parse_format("xml"), std::nullopt);
}

TEST(Log, ASinkSeesWhatIsAtOrAboveTheLevelAndIsPutBack) {
  std::vector<std::string> outer;
  std::vector<std::string> inner;
  const ScopedSink first([&](const Line& line) { outer.push_back(line.text); });
  {
    const ScopedSink second([&](const Line& line) { inner.push_back(line.text); });
    debug("test", "hidden");
    info("test", "seen");
  }
  warning("test", "later");
  EXPECT_THAT(inner, ::testing::ElementsAre("seen"));
  EXPECT_THAT(outer, ::testing::ElementsAre("later"));
}

TEST(Log, LevelsAreReadByName) {
  EXPECT_EQ(parse_level("debug"), Level::kDebug);
  EXPECT_EQ(parse_level("off"), Level::kOff);
  EXPECT_EQ(parse_level("loud"), std::nullopt);
}

}  // namespace
}  // namespace seeker::log
