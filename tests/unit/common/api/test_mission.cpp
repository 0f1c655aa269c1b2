#include "common/api/mission.hpp"

#include <cmath>
#include <limits>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/api/robot_api.hpp"

namespace seeker::api {
namespace {

using ::testing::HasSubstr;

/// Black and white halves: as much contrast as there is.
Image picture(int width_px = 32, int height_px = 32) {
  Image image(width_px, height_px, 1);
  for (std::size_t i = 0; i < image.data().size() / 2; ++i) {
    image.data()[i] = 255;
  }
  return image;
}

TargetSpec target(const std::string& name = "cross") {
  TargetSpec spec;
  spec.name = name;
  spec.picture = picture();
  return spec;
}

MissionRequest search_for(TargetSpec spec) {
  SearchMission search;
  search.targets = {std::move(spec)};
  return {"m-1", search, LinkPolicy::kStop, std::nullopt};
}

MissionRequest go_to(Point2 p) { return {"m-1", GotoMission{{p}, std::nullopt, {}}, LinkPolicy::kStop, std::nullopt}; }

const Polygon kSquare{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
const Polygon kBowTie{{0, 0}, {2, 2}, {2, 0}, {0, 2}};

TEST(MissionRequest, OrdinaryMissionsAreAccepted) {
  EXPECT_TRUE(validate(search_for(target())));
  EXPECT_TRUE(validate(go_to({1.0, -2.0})));
  EXPECT_TRUE(validate({"look-round", ExploreMission{}, LinkPolicy::kContinue, std::nullopt}));
  EXPECT_TRUE(validate({"back", ReturnMission{}, LinkPolicy::kReturn, std::chrono::seconds(5)}));
}

TEST(MissionRequest, ASolidNeedsNoPictureAndAPictureTargetDoes) {
  for (const SolidKind solid : kSolidKinds) {
    const TargetSpec spec = solid_target(solid);
    EXPECT_EQ(spec.name, to_string(solid));
    EXPECT_EQ(solid_named(spec.name), solid);
    EXPECT_TRUE(validate(search_for(spec))) << spec.name;
  }
  EXPECT_FALSE(solid_named("cube"));
  TargetSpec both = target();
  both.recogniser = RecogniserKind::kSolid;
  EXPECT_EQ(validate(search_for(both)).error().code, Errc::kInvalidArgument);
  TargetSpec neither = solid_target(SolidKind::kSphere);
  neither.recogniser = RecogniserKind::kTemplate;
  EXPECT_EQ(validate(search_for(neither)).error().code, Errc::kInvalidArgument);
  TargetSpec unknown = solid_target(SolidKind::kSphere);
  unknown.solid = static_cast<SolidKind>(9);
  EXPECT_EQ(validate(search_for(unknown)).error().code, Errc::kInvalidArgument);
}

TEST(MissionRequest, RecogniseNeedsTargetsAndHeadings) {
  const auto check = [](std::vector<TargetSpec> targets, int headings) {
    return validate({"m-1", RecogniseMission{std::move(targets), headings}, LinkPolicy::kStop, std::nullopt});
  };
  EXPECT_TRUE(check({target(), solid_target(SolidKind::kEllipsoid)}, 1));
  EXPECT_TRUE(check({target()}, kMaxHeadings));
  EXPECT_THAT(check({}, 1).error().message, HasSubstr("recognise needs 1 to 16 targets"));
  EXPECT_EQ(check({target(), target()}, 1).error().code, Errc::kInvalidArgument);
  EXPECT_EQ(check({target()}, 0).error().code, Errc::kInvalidArgument);
  EXPECT_EQ(check({target()}, kMaxHeadings + 1).error().code, Errc::kInvalidArgument);
  EXPECT_EQ(task_name(RecogniseMission{}), "recognise");
}

TEST(MissionRequest, IdOutsideItsAlphabetIsRefused) {
  for (const char* id : {"", "Upper", "with space", "../up", "semi;colon"}) {
    MissionRequest request = go_to({0, 0});
    request.id = id;
    EXPECT_FALSE(validate(request)) << "'" << id << "'";
  }
  MissionRequest request = go_to({0, 0});
  request.id = std::string(64, 'a');
  EXPECT_TRUE(validate(request));
  request.id += 'a';
  EXPECT_FALSE(validate(request));
}

TEST(MissionRequest, TimeLimitMustBeAboveZero) {
  MissionRequest request = go_to({0, 0});
  request.time_limit = Duration::zero();
  EXPECT_EQ(validate(request).error().code, Errc::kInvalidArgument);
}

TEST(MissionRequest, PictureThatCannotBeMatchedIsRefusedWithTheReason) {
  TargetSpec spec = target();
  spec.picture = Image();
  EXPECT_THAT(validate(search_for(spec)).error().message, HasSubstr("0x0 pixels"));
  spec.picture = Image(32, 32, 1, 90);
  EXPECT_THAT(validate(search_for(spec)).error().message, HasSubstr("one colour"));
  spec.picture = picture(kMaxTargetSide_px + 1, 32);
  EXPECT_EQ(validate(search_for(spec)).error().code, Errc::kTooLarge);
  spec.picture = picture(kMinTargetSide_px, kMinTargetSide_px);
  EXPECT_TRUE(validate(search_for(spec)));
}

TEST(MissionRequest, TargetSizeMustBeFiniteAndAboveZero) {
  for (const double width_m : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    TargetSpec spec = target();
    spec.width_m = width_m;
    EXPECT_FALSE(validate(search_for(spec))) << width_m;
  }
}

TEST(MissionRequest, NoTargetTwoOfANameAndTooManyAreRefused) {
  SearchMission search;
  EXPECT_FALSE(validate({"m", search, LinkPolicy::kStop, std::nullopt}));
  search.targets = {target("a"), target("a")};
  EXPECT_THAT(validate({"m", search, LinkPolicy::kStop, std::nullopt}).error().message, HasSubstr("'a'"));
  search.targets.clear();
  for (std::size_t i = 0; i <= kMaxTargets; ++i) {
    search.targets.push_back(target("t" + std::to_string(i)));
  }
  EXPECT_FALSE(validate({"m", search, LinkPolicy::kStop, std::nullopt}));
}

TEST(MissionRequest, CrossingPolygonIsRefusedAndNamed) {
  SearchMission search;
  search.targets = {target()};
  search.bound = kBowTie;
  EXPECT_THAT(validate({"m", search, LinkPolicy::kStop, std::nullopt}).error().message, HasSubstr("bound: "));
  search.bound = kSquare;
  search.keep_out = {kSquare, kBowTie};
  EXPECT_THAT(validate({"m", search, LinkPolicy::kStop, std::nullopt}).error().message, HasSubstr("keep-out area 2"));
}

TEST(MissionRequest, AreasOfAnExplorationAreChecked) {
  ExploreMission explore;
  explore.bound = kBowTie;
  EXPECT_THAT(validate({"m", explore, LinkPolicy::kStop, std::nullopt}).error().message, HasSubstr("bound: "));
  explore.bound = kSquare;
  explore.keep_out = std::vector<Polygon>(kMaxKeepOuts + 1, kSquare);
  EXPECT_EQ(validate({"m", explore, LinkPolicy::kStop, std::nullopt}).error().code, Errc::kTooLarge);
  explore.keep_out = {kSquare};
  EXPECT_TRUE(validate({"m", explore, LinkPolicy::kStop, std::nullopt}));
}

TEST(MissionRequest, SurveyAndLocaliseNeedANameAndHeadings) {
  const auto check = [](const MissionTask& task) { return validate({"m", task, LinkPolicy::kStop, std::nullopt}); };
  EXPECT_TRUE(check(SurveyMission{"lab", {}, 12, false, {}}));
  EXPECT_TRUE(check(LocaliseMission{"lab", 1}));
  EXPECT_THAT(check(SurveyMission{"My Lab", {}, 12, false, {}}).error().message, HasSubstr("landmarks"));
  EXPECT_EQ(check(LocaliseMission{"", 12}).error().code, Errc::kInvalidArgument);
  EXPECT_EQ(check(LocaliseMission{"lab", 0}).error().code, Errc::kInvalidArgument);
  EXPECT_EQ(check(SurveyMission{"lab", {}, kMaxHeadings + 1, false, {}}).error().code, Errc::kInvalidArgument);
  EXPECT_EQ(check(SurveyMission{"lab", std::vector<Point2>(kMaxSurveyPlaces + 1, Point2::Zero()), 12, false, {}})
                .error()
                .code,
            Errc::kTooLarge);
  EXPECT_EQ(check(SurveyMission{"lab", {{std::nan(""), 0.0}}, 12, false, {}}).error().code, Errc::kInvalidArgument);
  EXPECT_EQ(check(SurveyMission{"lab", {}, 12, false, {kBowTie}}).error().code, Errc::kInvalidArgument);
  EXPECT_EQ(task_name(SurveyMission{}), "survey");
  EXPECT_EQ(task_name(LocaliseMission{}), "localise");
}

TEST(MissionRequest, PublishedSearchDoesNotExplore) {
  MissionRequest request = search_for(target());
  std::get<SearchMission>(request.task).explore = true;
  EXPECT_TRUE(validate(request));
  std::get<SearchMission>(request.task).mode = SearchMode::kPaper;
  EXPECT_EQ(validate(request).error().code, Errc::kInvalidArgument);
}

TEST(MissionRequest, GotoNeedsFiniteWaypoints) {
  EXPECT_FALSE(validate(go_to({std::nan(""), 0.0})));
  EXPECT_FALSE(validate({"m", GotoMission{}, LinkPolicy::kStop, std::nullopt}));
  MissionRequest request = go_to({0, 0});
  std::get<GotoMission>(request.task).final_heading_rad = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(validate(request));
  std::get<GotoMission>(request.task) = {std::vector<Point2>(kMaxWaypoints + 1, Point2(0, 0)), std::nullopt, {}};
  EXPECT_FALSE(validate(request));
}

TEST(Names, EveryTopicAndOutcomeHasItsOwn) {
  std::set<std::string> topics;
  for (std::size_t i = 0; i < kTopicCount; ++i) {
    topics.insert(std::string(to_string(static_cast<Topic>(i))));
  }
  EXPECT_EQ(topics.size(), kTopicCount);
  std::set<std::string> outcomes;
  for (int i = 0; i <= static_cast<int>(Outcome::kFault); ++i) {
    outcomes.insert(std::string(to_string(static_cast<Outcome>(i))));
  }
  EXPECT_EQ(outcomes.size(), static_cast<std::size_t>(Outcome::kFault) + 1);
}

TEST(ExploreMission, DrivesToursUnlessAnotherStrategyIsNamed) {
  EXPECT_EQ(ExploreMission{}.strategy, ExploreStrategy::kTour);
}

TEST(Names, EveryStrategyAndTaskHasItsOwn) {
  std::set<std::string> strategies;
  for (const ExploreStrategy strategy : kExploreStrategies) {
    strategies.insert(std::string(to_string(strategy)));
  }
  EXPECT_EQ(strategies.size(), kExploreStrategies.size());
  EXPECT_EQ(static_cast<std::size_t>(kExploreStrategies.back()) + 1, kExploreStrategies.size());
  EXPECT_EQ(task_name(ExploreMission{}), "explore");
}

TEST(Names, OnlyMissionEventAndDetectionAreReliable) {
  std::set<Topic> reliable;
  for (std::size_t i = 0; i < kTopicCount; ++i) {
    if (stream_class(static_cast<Topic>(i)) == StreamClass::kReliable) {
      reliable.insert(static_cast<Topic>(i));
    }
  }
  EXPECT_EQ(reliable, (std::set<Topic>{Topic::kMission, Topic::kEvent, Topic::kDetection, Topic::kSegments}));
}

}  // namespace
}  // namespace seeker::api
