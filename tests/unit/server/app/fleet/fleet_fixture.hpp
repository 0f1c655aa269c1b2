/// \file
/// Parts of the main robot of a fleet, each without the others: no network, no worker, no loop.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "server/app/fleet/member_book.hpp"
#include "tests/integration/fleet/fleet_world.hpp"
#include "tests/integration/fleet/toy_robot.hpp"

namespace seeker::testing {

inline const app::WallTime kStart{std::chrono::hours(1)};

/// A map with one scan per local map, 0.8 m apart.
inline LineMap small_map(std::size_t nodes = 2, std::uint64_t seed = 1) {
  std::vector<Pose2> poses;
  for (std::size_t k = 0; k < nodes; ++k) {
    poses.push_back({1.0 + 0.8 * static_cast<double>(k), 6.0, 0.0});
  }
  return fleet::toy_map(fleet::office(1), poses, seed, {}, 1);
}

/// Writes down what the book asks for, such as "judge r1".
struct AskedErrands {
  std::vector<std::string> asked;
  bool full = false;  ///< the worker's queue

  [[nodiscard]] app::FleetErrands errands() {
    app::FleetErrands errands;
    errands.keep_piece = [this](const std::string& id, const api::PieceHash&, const app::PieceBytes&) {
      asked.push_back("piece " + id);
    };
    errands.keep_record = [this](const std::string& id) {
      asked.push_back("record " + id);
      return !full;
    };
    errands.judge = [this](const std::string& id) {
      asked.push_back("judge " + id);
      return !full;
    };
    errands.notify_operator = [this](const std::string& kind, const std::string&, api::Severity) {
      asked.push_back("event " + kind);
    };
    return errands;
  }
  /// How often it was asked for, and forgets all.
  std::size_t take(const std::string& what) {
    const std::size_t count = static_cast<std::size_t>(std::count(asked.begin(), asked.end(), what));
    asked.clear();
    return count;
  }
};

/// A book of members whose judge and worker are the test.
struct BookParts {
  explicit BookParts(const app::MemberBookParams& params = {}) : book(params, main, asked.errands()) {}

  /// Announces a map and sends everything that is missing.
  void join(const app::PackedMap& robot, app::WallTime now = kStart) {
    const auto answer = book.announce(robot.manifest, now);
    ASSERT_TRUE(answer) << answer.error().message;
    for (const api::FleetMissing& missing : answer->missing) {
      ASSERT_TRUE(book.receive({robot.manifest.robot_id, missing.hash, 0, *robot.pieces.at(missing.hash)}));
    }
  }

  AskedErrands asked;
  app::OwnRobot main{"main"};
  app::MemberBook book;
};

inline fleet::MergeAnswer answer_with(fleet::MergeVerdict verdict, const Pose2& main_T_map) {
  fleet::MergeAnswer answer;
  answer.verdict = verdict;
  answer.reason = "as the test says";
  fleet::MergeHypothesis hypothesis;
  hypothesis.a_T_b.a_T_b = main_T_map;
  hypothesis.confidence = 0.8;
  answer.hypotheses = {hypothesis};
  return answer;
}

/// The map of one robot is merged with that of the main one.
inline app::JoinOutcome merged_at(const Pose2& main_T_map, std::uint8_t slot = 1) {
  app::JoinOutcome outcome;
  outcome.pairs = {{app::kMainSlot, slot, answer_with(fleet::MergeVerdict::kMerged, main_T_map)}};
  outcome.links = {{slot, {app::kMainSlot, 0.9}}};
  outcome.main_T_maps = {{slot, main_T_map}};
  return outcome;
}

/// The pair of the main robot and another one has a verdict, and there is no joint map.
inline app::JoinOutcome apart_with(fleet::MergeVerdict verdict, std::uint8_t slot = 1) {
  app::JoinOutcome outcome;
  outcome.pairs = {{app::kMainSlot, slot, answer_with(verdict, {1.0, 2.0, 0.0})}};
  return outcome;
}

/// With features that nobody would see.
inline fleet::NodePicture picture_of(std::uint32_t node, std::size_t features = 3) {
  fleet::NodePicture picture;
  picture.node = node;
  picture.node_T_base = {1.25, -0.5, 0.75};
  for (std::size_t k = 0; k < features; ++k) {
    picture.features.bearings_rad.push_back(static_cast<float>(k) * 0.5F);
    picture.features.descriptors.emplace_back().fill(static_cast<std::uint8_t>(200 + k % 50));
  }
  return picture;
}

inline fleet::NodePictures pictures_of(const std::vector<fleet::NodePicture>& pictures) {
  fleet::NodePictures all;
  for (const fleet::NodePicture& picture : pictures) {
    all.push_back(std::make_shared<const fleet::NodePicture>(picture));
  }
  return all;
}

}  // namespace seeker::testing
