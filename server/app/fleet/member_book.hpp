/// \file
/// The book of members of a fleet: who has joined the main robot, and what each has announced and reported.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "common/api/fleet.hpp"
#include "server/app/fleet/fleet_errands.hpp"
#include "server/app/fleet/fleet_slots.hpp"
#include "server/app/fleet/member.hpp"
#include "server/app/fleet/member_record.hpp"
#include "server/app/fleet/other_robot.hpp"
#include "server/app/fleet/own_robot.hpp"
#include "server/app/fleet/robot_report.hpp"

namespace seeker::app {

struct MemberBookParams {
  Duration silence_limit = std::chrono::seconds(5);  ///< see FleetSettings
  Duration retry_period = std::chrono::seconds(10);  ///< wall time until the same map is judged again
};

/// A robot that has reported, and what it may be sent of the others.
struct ReportingRobot {
  api::FleetState state = api::FleetState::kWaiting;
  std::optional<Pose2> main_T_map;  ///< absent where it is not merged: nothing is sent to it
  std::optional<Pose2> map_T_base;
  std::vector<OtherRobot> others;  ///< the other members that are merged, by id; the main robot is not among them
};

/// The map of a member for the judge.
struct MemberMap {
  std::uint8_t slot = 1;
  api::FleetManifest manifest;
  Pieces pieces;
};

/// All members but the main robot. Any thread may call all of it but load(): one mutex guards the members, so that each
/// call sees and leaves them as a whole. While it is locked the book calls its errands, and the main robot, whose mutex
/// is taken after this one. Nothing that a robot sends changes the entry of another one.
class MemberBook {
 public:
  /// `main` must outlive this.
  MemberBook(const MemberBookParams& params, const OwnRobot& main, FleetErrands errands);

  /// What the disk holds; before anybody else calls this.
  void load(FleetSlots slots, std::vector<MemberRecord> records);
  /// Asks for the judgement of all members whose pieces are complete.
  void judge_complete();

  /// Takes the manifest of a robot. kRefused: another robot has this id; kTooLarge.
  [[nodiscard]] Result<api::FleetAnswer> announce(const api::FleetManifest& manifest, WallTime now);
  /// Bytes of the piece that are there afterwards. kNotFound: nobody has announced it; errors of
  /// AnnouncedMap::receive().
  [[nodiscard]] Result<std::uint64_t> receive(const api::FleetChunk& chunk);
  /// kNotFound: the robot has to announce its map first.
  [[nodiscard]] Result<ReportingRobot> receive(const api::FleetShare& share, WallTime now);
  /// As above.
  [[nodiscard]] Result<ReportingRobot> receive(const api::FleetSeen& seen, WallTime now);
  [[nodiscard]] api::FleetStatus status(WallTime now) const;
  /// The operator's decision. kNotFound, kRefused.
  [[nodiscard]] Result<api::FleetStatus> decide(const api::FleetDecision& decision, WallTime now);
  /// All members that are merged, in the frame `map` of the main robot.
  [[nodiscard]] std::vector<OtherRobot> merged(WallTime now) const;

  // For the memory on the disk.
  /// The worker begins to write the record that was asked for.
  void begin_record(const std::string& robot_id);
  /// The robot must have joined.
  [[nodiscard]] MemberRecord record_of(const std::string& robot_id) const;
  /// Numbers of all robots that have ever joined, but for the main one.
  [[nodiscard]] std::map<std::string, std::uint8_t> slots();

  // For the judge.
  [[nodiscard]] std::vector<MemberMap> maps() const;
  /// The newest map of a robot that has joined; nothing while pieces are missing.
  [[nodiscard]] std::optional<MemberMap> begin_judgement(const std::string& robot_id, WallTime now);
  /// Why the map of a robot cannot be judged; empty: it can.
  void set_trouble(const std::string& robot_id, std::string trouble);
  /// Slots of the members but one whose maps are compared with others.
  [[nodiscard]] std::vector<std::uint8_t> comparable_but(std::uint8_t slot) const;
  /// What of the pairs counts in a map join: that of robots which take part, with the operator's decisions applied.
  [[nodiscard]] std::vector<fleet::PairAnswer> taking_part(std::vector<fleet::PairAnswer> pairs);
  /// Enters the outcome of a map join; a new state of a robot is an event.
  void settle(const JoinOutcome& outcome);

 private:
  // All with the mutex locked.
  [[nodiscard]] Status check_namesake(const api::FleetManifest& manifest, WallTime now) const;
  /// Null: a robot of this id and program has not announced its map.
  [[nodiscard]] Member* find(const std::string& robot_id, std::uint64_t instance);
  [[nodiscard]] std::uint8_t number_for(const std::string& robot_id) const;
  void ask_for_judgement(const std::string& robot_id, Member& member);
  void ask_for_record(const std::string& robot_id, Member& member);
  [[nodiscard]] ReportingRobot received(const std::string& robot_id, const Member& member, WallTime now) const;
  [[nodiscard]] std::vector<OtherRobot> others_than(const std::string& robot_id, const Pose2& main_T_map,
                                                    WallTime now) const;
  [[nodiscard]] api::FleetStatus status_now(WallTime now) const;
  void report_state(const Member& member) const;

  const MemberBookParams params_;
  const OwnRobot& main_;
  const FleetErrands errands_;
  mutable std::mutex mutex_;  ///< guards what follows
  std::map<std::string, Member> members_;
  FleetSlots slots_;
  std::uint32_t revision_ = 0;  ///< rises with every change of who is merged and how
};

}  // namespace seeker::app
