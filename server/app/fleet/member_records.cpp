#include "server/app/fleet/member_records.hpp"

#include <set>
#include <utility>

#include "common/log/log.hpp"
#include "common/wire/convert.hpp"
#include "common/wire/convert_fleet.hpp"
#include "common/wire/envelope.hpp"
#include "common/wire/fleet_fields.hpp"
#include "seeker/v1/fleet.pb.h"
#include "server/app/fleet/fleet_settings.hpp"
#include "server/app/state/kept_message.hpp"

namespace seeker::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRecordFile = "record";
constexpr const char* kRecordKind = "fleet-robot";

}  // namespace

MemberRecords::MemberRecords(fs::path folder, const PieceFiles& pieces, ReportDamage report_damage)
    : folder_(std::move(folder)), pieces_(pieces), report_damage_(std::move(report_damage)) {}

std::vector<MemberRecord> MemberRecords::load(const std::string& main_robot_id) const {
  std::error_code error;
  std::set<fs::path> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, error)) {
    if (entry.is_directory() && entry.path().filename() != main_robot_id) {
      names.insert(entry.path().filename());
    }
  }
  std::vector<MemberRecord> records;
  records.reserve(names.size());
  for (const fs::path& name : names) {
    if (std::optional<MemberRecord> record = load_one(name.string())) {
      records.push_back(std::move(*record));
    }
  }
  return records;
}

std::optional<MemberRecord> MemberRecords::load_one(const std::string& robot_id) const {
  const auto kept =
      read_kept_message<v1::FleetRecord>(folder_ / robot_id / kRecordFile, kRecordKind, wire::kMaxFrameBytes);
  if (!kept && kept.error().code == Errc::kNotFound) {
    return std::nullopt;  // cut off before there was one
  }
  Result<api::FleetManifest> manifest = kept ? wire::from_message<api::FleetManifest>(kept->manifest())
                                             : Result<api::FleetManifest>(tl::unexpected<Error>(kept.error()));
  if (!manifest || manifest->robot_id != robot_id) {
    report_damage_("what robot '" + robot_id + "' had sent cannot be read again, it has to send all of it: " +
                   (manifest ? "the record is that of another robot" : manifest.error().message));
    return std::nullopt;
  }
  MemberRecord record;
  record.pieces = pieces_.load(*manifest);
  record.manifest = std::move(*manifest);
  record.split = kept->split();
  if (kept->has_accepted_main_t_map()) {
    if (const Result<Pose2> accepted = wire::from_message<Pose2>(kept->accepted_main_t_map())) {
      record.accepted = *accepted;
    }
  }
  if (kept->has_topology()) {
    if (Result<RobotTopology> topology = wire::from_message<RobotTopology>(kept->topology())) {
      record.topology = std::move(*topology);
    }
  }
  record.finds = {read_found(kept->detections(), robot_id, report_damage_),
                  read_found(kept->earlier_detections(), robot_id, report_damage_)};
  return record;
}

void MemberRecords::keep(const std::string& robot_id, const std::function<MemberRecord()>& newest) {
  const std::lock_guard writing(mutex_);
  const MemberRecord record = newest();
  v1::FleetRecord message;
  wire::write(record.manifest, message.mutable_manifest());
  message.set_split(record.split);
  if (record.accepted) {
    wire::write(*record.accepted, message.mutable_accepted_main_t_map());
  }
  if (record.topology) {
    wire::write(*record.topology, message.mutable_topology());
  }
  wire::write_detections(api::within_limits(record.finds.now), message.mutable_detections());
  wire::write_detections(api::within_limits(record.finds.before), message.mutable_earlier_detections());
  const fs::path file = folder_ / robot_id / kRecordFile;
  if (const Status kept = store::write_sealed_file(file, kRecordKind, message.SerializeAsString()); !kept) {
    log::warning(kFleetPart, "what '" + robot_id + "' announced is not kept: " + kept.error().message);
    return;
  }
  pieces_.drop_all_but(robot_id, record.pieces);
}

}  // namespace seeker::app
