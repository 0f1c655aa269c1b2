// Three robots with cameras, each with a server of its own: the pictures of their topologies' nodes travel to the main
// robot by pieces, over real sockets, and speak for the merge of their maps.

#include "common/files/files.hpp"
#include "server/app/fleet/picture_piece.hpp"
#include "tests/integration/processes/fleet_team.hpp"

namespace seeker::testing {
namespace {

/// What the main robot has received of another one and keeps on its disk.
std::vector<fleet::NodePicture> pictures_on_disk(const std::filesystem::path& folder) {
  std::vector<fleet::NodePicture> pictures;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const Result<std::vector<std::uint8_t>> piece = files::read_file(entry.path(), api::kMaxFleetPieceBytes);
    // Pieces of local maps are no pictures; one that is not needed any more may be gone.
    if (Result<fleet::NodePicture> picture = piece ? app::decode_picture(*piece) : fail(Errc::kNotFound, "gone")) {
      EXPECT_LE(piece->size(), api::kMaxFleetPictureBytes);
      pictures.push_back(std::move(*picture));
    }
  }
  return pictures;
}

TEST(FleetPictures, TravelByPiecesAndSpeakForTheMerge) {
  constexpr std::size_t kMembers = 3;
  Team team("fleet_pictures", source_file("tests/support/worlds/studio.yaml"), kMembers);
  for (std::size_t k = 0; k < kMembers; ++k) {
    team.start(k);
  }
  for (std::size_t k = 0; k < kMembers; ++k) {
    team.explore(k);
  }
  const api::FleetStatus fleet = team.until([](const api::FleetMember& member) {
    return member.state == api::FleetState::kMerged && member.main_T_map && member.pieces_missing == 0 &&
           member.merged_with && member.merged_with->pictures > 0;
  });
  team.expect_near_truth(fleet, 0.2, 2.0);
  std::string shown;
  const std::string main = "127.0.0.1:" + std::to_string(team.fleet_port());
  EXPECT_EQ(seeker(team.robot(0), {"fleet", "status", "--main", main}, &shown), 0) << shown;
  EXPECT_NE(shown.find("confirm it"), std::string::npos) << shown;
  for (std::size_t k = 1; k < fleet.members.size(); ++k) {
    const std::vector<fleet::NodePicture> pictures = pictures_on_disk(team.pieces(k));
    EXPECT_GE(fleet.members[k].pictures, fleet.members[k].merged_with->pictures);
    EXPECT_FALSE(pictures.empty()) << fleet.members[k].robot_id;
    for (const fleet::NodePicture& picture : pictures) {
      EXPECT_GT(picture.features.size(), 0U) << fleet.members[k].robot_id;
    }
  }
}

}  // namespace
}  // namespace seeker::testing
