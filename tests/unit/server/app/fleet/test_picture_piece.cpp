#include "server/app/fleet/picture_piece.hpp"

#include <cmath>
#include <optional>

#include "seeker/v1/fleet.pb.h"
#include "server/app/fleet/announced_map.hpp"
#include "tests/unit/server/app/fleet/fleet_fixture.hpp"

namespace seeker::testing {
namespace {

TEST(PicturePiece, HoldsWhatWasPutIntoIt) {
  const fleet::NodePicture picture = picture_of(4);
  const std::vector<std::uint8_t> bytes = app::encode_picture(picture);
  EXPECT_EQ(app::encode_picture(picture), bytes);
  const auto read = app::decode_picture(bytes);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(*read, picture);
}

TEST(PicturePiece, OfTheMostFeaturesFitsIntoAPiece) {
  const std::vector<std::uint8_t> bytes = app::encode_picture(picture_of(1, 2 * api::kMaxFleetPictureFeatures));
  EXPECT_LE(bytes.size(), api::kMaxFleetPictureBytes);
  EXPECT_EQ(app::decode_picture(bytes).value().features.size(), api::kMaxFleetPictureFeatures);
}

TEST(PicturePiece, TrustsNothing) {
  const auto code_of = [](const v1::FleetPictureFeatures& message) {
    const std::string text = message.SerializeAsString();
    const auto read = app::decode_picture(std::vector<std::uint8_t>(text.begin(), text.end()));
    return read ? std::nullopt : std::optional(read.error().code);
  };
  v1::FleetPictureFeatures message;
  message.set_node(1);
  EXPECT_EQ(code_of(message), Errc::kInvalidArgument) << "no pose";
  message.mutable_node_t_base();
  message.add_bearings(0.5F);
  EXPECT_EQ(code_of(message), Errc::kInvalidArgument) << "no descriptor";
  message.set_descriptors(std::string(vision::kDescriptorSize, 'x'));
  EXPECT_EQ(code_of(message), std::nullopt);
  message.set_bearings(0, std::nanf(""));
  EXPECT_EQ(code_of(message), Errc::kInvalidArgument) << "not finite";
  message.mutable_bearings()->Resize(static_cast<int>(api::kMaxFleetPictureFeatures) + 1, 0.0F);
  EXPECT_EQ(code_of(message), Errc::kTooLarge);
  EXPECT_EQ(app::decode_picture(std::vector<std::uint8_t>{0xFF, 0xFF}).error().code, Errc::kParse);
}

TEST(PackedPictures, TravelAsPiecesOfTheirOwnBesideTheLocalMaps) {
  const LineMap map = small_map();
  const std::uint32_t node = map.nodes.back().id;
  const app::PackedMap robot =
      app::pack_map(map, "r1", pictures_of({picture_of(node), picture_of(node + 1000)})).value();
  ASSERT_EQ(robot.manifest.pictures.size(), 1U) << "that of a local map which is not there shows nothing";
  app::AnnouncedMap announced;
  announced.announce(robot.manifest);
  const auto missing = announced.missing();
  ASSERT_EQ(missing.size(), map.nodes.size() + 1);
  EXPECT_EQ(missing.back().hash, robot.manifest.pictures.front().hash) << "local maps come first";
  for (const api::FleetMissing& one : missing) {
    ASSERT_TRUE(announced.receive({"r1", one.hash, 0, *robot.pieces.at(one.hash)}));
  }
  EXPECT_TRUE(announced.missing().empty());
  const auto pictures = app::unpack_pictures(robot.manifest, announced.pieces());
  ASSERT_TRUE(pictures) << pictures.error().message;
  ASSERT_EQ(pictures->size(), 1U);
  EXPECT_EQ(*pictures->front(), picture_of(node));
  EXPECT_EQ(app::unpack_map(robot.manifest, announced.pieces()).value().nodes.size(), map.nodes.size());
}

TEST(PackedPictures, StayTheSameWhenTheMapAroundThemMoves) {
  LineMap map = small_map();
  const auto pictures = pictures_of({picture_of(map.nodes.back().id)});
  const auto before = app::pack_map(map, "r1", pictures).value().manifest.pictures;
  map.nodes.back().map_T_node.x_m += 0.3;
  EXPECT_EQ(app::pack_map(map, "r1", pictures).value().manifest.pictures, before);
}

}  // namespace
}  // namespace seeker::testing
