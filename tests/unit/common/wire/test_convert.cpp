#include <limits>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "common/wire/convert.hpp"
#include "common/wire/envelope.hpp"
#include "tests/unit/common/wire/generators.hpp"

namespace seeker::wire {
namespace {

using testing::ValueMaker;

/// Through bytes and back.
template <class M, class T>
void expect_round_trip(const T& value) {
  M message;
  ASSERT_TRUE(message.ParseFromString(to_message<M>(value).SerializeAsString()));
  const Result<T> back = from_message<T>(message);
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(*back, value);
}

RC_GTEST_PROP(Convert, EveryValueComesBackUnchanged, (std::uint64_t seed)) {
  ValueMaker make(seed);
  expect_round_trip<pb::LaserScan>(make.scan());
  expect_round_trip<pb::SonarScan>(make.sonar());
  expect_round_trip<pb::Image>(make.image());
  expect_round_trip<pb::ImageFrame>(make.frame());
  expect_round_trip<pb::TileUpdate>(make.tiles());
  expect_round_trip<pb::Detection>(make.detection());
  expect_round_trip<pb::GridReport>(make.grid());
  expect_round_trip<pb::ExploreDecision>(make.decision());
  expect_round_trip<pb::MissionRequest>(make.mission());
  expect_round_trip<pb::MissionStatus>(make.mission_status());
  expect_round_trip<pb::RobotStatus>(make.status());
  expect_round_trip<pb::RobotInfo>(make.info());
  expect_round_trip<pb::ComponentInfo>(make.component());
  expect_round_trip<pb::ComponentSetting>(make.setting());
  expect_round_trip<pb::LeaseState>(make.lease());
  expect_round_trip<pb::Event>(make.event());
  expect_round_trip<pb::DriveCommand>(make.drive());
  expect_round_trip<pb::LineReport>(make.lines());
  expect_round_trip<pb::Segment>(make.segment());
  expect_round_trip<pb::SegmentUpdate>(make.segments());
  expect_round_trip<pb::MapSummary>(make.map_summary());
  expect_round_trip<pb::LandmarkSummary>(make.landmark_summary());
  expect_round_trip<pb::Landmark>(make.landmark());
  expect_round_trip<pb::LineMapStatus>(make.line_map());
  expect_round_trip<pb::PoseList>(make.trajectory());
  RC_ASSERT(!::testing::Test::HasFailure());
}

RC_GTEST_PROP(Convert, AnUpdateEncodedOnceIsReadByEveryReceiver, (std::uint64_t seed)) {
  ValueMaker make(seed);
  api::Update update;
  update.topic = make.one_of(api::Topic::kTopology);
  update.sequence = seed + 1;
  update.stamp = make.time();
  update.payload = make.payload(update.topic);
  const SharedBody body = encode_body(update);
  for (const std::uint64_t dropped : {std::uint64_t{0}, seed}) {
    const OutFrame frame = stream_frame(body, 17, dropped);
    FrameDecoder decoder;
    RC_ASSERT(decoder.feed(frame.head + *frame.body + frame.tail).has_value());
    const auto envelope = parse_envelope(*decoder.next());
    RC_ASSERT(envelope.has_value());
    RC_ASSERT(envelope->stream_update().subscription_id() == 17U);
    const auto back = from_message<api::Update>(envelope->stream_update());
    RC_ASSERT(back.has_value());
    RC_ASSERT(back->payload == update.payload);
    RC_ASSERT(back->dropped == dropped);
    RC_ASSERT(back->stamp == update.stamp);
  }
}

RC_GTEST_PROP(Convert, TilesEncodedOneByOneAreOneUpdate, (std::uint64_t seed)) {
  ValueMaker make(seed);
  const api::TileUpdate tiles = make.tiles();
  std::vector<SharedBody> entries;
  for (const OccupancyTile& tile : tiles.tiles) {
    entries.push_back(encode_tile(tile));
  }
  pb::StreamUpdate message;
  RC_ASSERT(message.ParseFromString(*join_tiles({5, robot_time_s(2.0), tiles.revision, tiles.map_epoch}, entries)));
  const auto back = from_message<api::Update>(message);
  RC_ASSERT(back.has_value());
  RC_ASSERT(back->payload == api::Payload(tiles));
}

RC_GTEST_PROP(Convert, AnyBytesBecomeValidText, (std::string bytes)) {
  pb::Event event;
  event.set_text(clean_text(bytes));
  RC_ASSERT(event.ParseFromString(event.SerializeAsString()));
}

TEST(Convert, LongTextIsCutAtACharacter) {
  EXPECT_EQ(clean_text("aé", 2), "a");
  EXPECT_EQ(clean_text("a\xff"
                       "b"),
            "a?b");
}

/// What is refused, and the field that the error names.
template <class T, class M>
void expect_refused(const M& message, const std::string& field, Errc code) {
  const Result<T> value = from_message<T>(message);
  ASSERT_FALSE(value) << field;
  EXPECT_EQ(value.error().code, code) << value.error().message;
  EXPECT_NE(value.error().message.find("'" + field + "'"), std::string::npos) << value.error().message;
}

TEST(Convert, PlacesOfOlderRobotsHaveNoCauseAndNewCausesAreNoError) {
  api::MissionStatus ended;
  ended.state = api::MissionState::kEnded;
  ended.end = api::MissionEnd{api::Outcome::kUnreachable, "cause", "", {}};
  ended.end->unreachable.push_back({{1.0, 2.0}, UnreachableCause::kOutsideBound, 0.8, "the text"});
  auto message = to_message<pb::MissionStatus>(ended);
  EXPECT_EQ(message.end().unreachable().x_m_size(), 1) << "clients of older software read the points";
  message.mutable_end()->mutable_unreachable_places(0)->set_cause(static_cast<pb::UnreachableCause>(99));
  const auto unknown = from_message<api::MissionStatus>(message);
  ASSERT_TRUE(unknown) << unknown.error().message;
  EXPECT_EQ(unknown->end->unreachable.front(),
            (UnreachablePlace{{1.0, 2.0}, UnreachableCause::kNotStated, 0.8, "the text"}));
  message.mutable_end()->clear_unreachable_places();
  const auto older = from_message<api::MissionStatus>(message);
  ASSERT_TRUE(older) << older.error().message;
  EXPECT_EQ(older->end->unreachable,
            (std::vector<UnreachablePlace>{{{1.0, 2.0}, UnreachableCause::kNotStated, 0.0, ""}}));
}

TEST(Convert, RefusalsNameTheField) {
  ValueMaker make(1);
  auto status = to_message<pb::RobotStatus>(make.status());
  status.mutable_pose()->mutable_map_t_base()->set_y_m(std::numeric_limits<double>::quiet_NaN());
  expect_refused<api::RobotStatus>(status, "pose.map_t_base.y_m", Errc::kInvalidArgument);
  status = to_message<pb::RobotStatus>(make.status());
  status.clear_velocity();
  expect_refused<api::RobotStatus>(status, "velocity", Errc::kInvalidArgument);
  status = to_message<pb::RobotStatus>(make.status());
  status.mutable_pose()->set_quality(static_cast<pb::LocalisationQuality>(99));
  expect_refused<api::RobotStatus>(status, "pose.quality", Errc::kInvalidArgument);
  auto event = to_message<pb::Event>(make.event());
  event.set_severity(pb::SEVERITY_UNSPECIFIED);
  expect_refused<api::Event>(event, "severity", Errc::kInvalidArgument);
  event = to_message<pb::Event>(make.event());
  event.set_text(std::string(kMaxTextBytes + 1, 'x'));
  expect_refused<api::Event>(event, "text", Errc::kTooLarge);
  pb::DriveCommand drive = to_message<pb::DriveCommand>(make.drive());
  drive.set_ttl_ns(2'000'000'000);
  expect_refused<api::DriveCommand>(drive, "ttl_ns", Errc::kInvalidArgument);
  pb::MissionRequest explore;
  explore.set_id("m");
  explore.mutable_explore()->set_strategy(static_cast<pb::ExploreStrategy>(pb::ExploreStrategy_MAX + 1));
  expect_refused<api::MissionRequest>(explore, "explore.strategy", Errc::kInvalidArgument);
  pb::MissionRequest survey;
  survey.set_id("m");
  survey.mutable_survey()->set_headings(1U << 31U);
  expect_refused<api::MissionRequest>(survey, "survey.headings", Errc::kInvalidArgument);
  pb::MissionRequest recognise;
  recognise.set_id("m");
  recognise.mutable_recognise()->set_headings(1);
  pb::Target& target = *recognise.mutable_recognise()->add_targets();
  target.set_recogniser(pb::RECOGNISER_SOLID);
  expect_refused<api::MissionRequest>(recognise, "recognise.targets[0].solid", Errc::kInvalidArgument);
  target.set_recogniser(pb::RECOGNISER_TEMPLATE);
  expect_refused<api::MissionRequest>(recognise, "recognise.targets[0].picture", Errc::kInvalidArgument);
  auto landmark = to_message<pb::Landmark>(make.landmark());
  landmark.set_z_m(std::nan(""));
  expect_refused<api::LandmarkPoint>(landmark, "z_m", Errc::kInvalidArgument);
  landmark.set_id(0);
  expect_refused<api::LandmarkPoint>(landmark, "id", Errc::kInvalidArgument);
  pb::MissionRequest nothing;
  nothing.set_id("m");
  expect_refused<api::MissionRequest>(nothing, "task", Errc::kInvalidArgument);
}

TEST(Convert, SegmentsOfAPeerAreNotTrusted) {
  ValueMaker make(2);
  auto segment = to_message<pb::Segment>(make.segment());
  segment.set_id(0);
  expect_refused<MapSegment>(segment, "id", Errc::kInvalidArgument);
  segment = to_message<pb::Segment>(make.segment());
  segment.set_length_m(-1.0);
  expect_refused<MapSegment>(segment, "length_m", Errc::kInvalidArgument);
  pb::SegmentUpdate update;
  for (std::size_t k = 0; k <= api::kMaxSegmentsPerUpdate; ++k) {
    update.add_removed(k);
  }
  expect_refused<api::SegmentUpdate>(update, "changed", Errc::kTooLarge);
  pb::PoseList poses;
  poses.add_x_m(1.0);
  poses.add_y_m(1.0);
  poses.add_theta_rad(1.0);
  EXPECT_TRUE(from_message<std::vector<api::StampedPose>>(poses)) << "an older robot tells no stamps";
  poses.add_stamp_ns(1);
  poses.add_stamp_ns(2);
  EXPECT_FALSE(from_message<std::vector<api::StampedPose>>(poses));
}

TEST(Convert, DecisionsOfAPeerAreNotTrusted) {
  pb::ExploreDecision decision;
  for (std::size_t k = 0; k <= kMaxDecisionCandidates; ++k) {
    decision.add_candidates();
  }
  expect_refused<ExploreDecision>(decision, "candidates", Errc::kTooLarge);
  decision = to_message<pb::ExploreDecision>(
      ExploreDecision{.number = 1, .stamp = {}, .rule = "one-step", .candidates = {{}, {}}, .chosen = 1, .why = ""});
  EXPECT_TRUE(from_message<ExploreDecision>(decision));
  decision.set_chosen(2);
  expect_refused<ExploreDecision>(decision, "chosen", Errc::kInvalidArgument);
  decision.clear_chosen();
  decision.mutable_candidates(1)->set_score(-std::numeric_limits<double>::infinity());
  expect_refused<ExploreDecision>(decision, "candidates[1].score", Errc::kInvalidArgument);
  decision.mutable_candidates(1)->clear_map_t_base();
  expect_refused<ExploreDecision>(decision, "candidates[1].map_t_base", Errc::kInvalidArgument);
}

TEST(Convert, ADecisionWithTooManyCandidatesTravelsCut) {
  ExploreDecision decision;
  decision.candidates.resize(kMaxDecisionCandidates + 1);
  decision.chosen = static_cast<std::uint32_t>(kMaxDecisionCandidates);
  const auto back = from_message<ExploreDecision>(to_message<pb::ExploreDecision>(decision));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->candidates.size(), kMaxDecisionCandidates);
  EXPECT_FALSE(back->chosen) << "what was chosen did not travel";
}

TEST(Convert, SizesAreBoundedBeforeMemoryIsSpent) {
  pb::Image image;
  image.set_width_px(8192);
  image.set_height_px(8192);
  image.set_channels(3);
  image.set_encoding(pb::Image::ENCODING_ZSTD);
  expect_refused<Image>(image, "data", Errc::kTooLarge);
  image.set_width_px(100'000);
  expect_refused<Image>(image, "width_px", Errc::kTooLarge);
  pb::LaserScan scan = to_message<pb::LaserScan>(ValueMaker(3).scan());
  scan.mutable_ranges_m()->Resize(static_cast<int>(kMaxScanBeams) + 1, 1.0F);
  expect_refused<LaserScan>(scan, "ranges_m", Errc::kTooLarge);
  pb::TileUpdate tiles;
  for (std::size_t k = 0; k <= kMaxTilesPerUpdate; ++k) {
    tiles.add_tiles();
  }
  expect_refused<api::TileUpdate>(tiles, "tiles", Errc::kTooLarge);
}

TEST(Convert, ATileMustUnpackToExactlyItsCells) {
  pb::TileUpdate update = to_message<pb::TileUpdate>(api::TileUpdate{1, 0, {OccupancyTile{}}});
  update.mutable_tiles(0)->mutable_cells_zstd()->pop_back();
  expect_refused<api::TileUpdate>(update, "tiles[0].cells_zstd", Errc::kCorrupt);
}

TEST(Convert, AFrameOfCountlessTinyMessagesIsRefusedBeforeTheyAreBuilt) {
  pb::Envelope envelope;
  auto* targets = envelope.mutable_request()->mutable_start_mission()->mutable_mission()->mutable_search();
  for (std::size_t k = 0; k <= kMaxMessagesPerFrame; ++k) {
    targets->add_targets();
  }
  const auto parsed = parse_envelope(envelope.SerializeAsString());
  ASSERT_FALSE(parsed);
  EXPECT_EQ(parsed.error().code, Errc::kTooLarge);
}

TEST(Convert, BytesThatAreNoEnvelopeAreRefused) {
  for (const std::string& bytes : {std::string(), std::string("\xff\xff\xff"), std::string("\x2a\x7f", 2)}) {
    EXPECT_FALSE(parse_envelope(bytes));
  }
}

}  // namespace
}  // namespace seeker::wire
