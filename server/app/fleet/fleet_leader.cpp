#include "server/app/fleet/fleet_leader.hpp"

#include <memory>
#include <utility>

#include "common/log/log.hpp"
#include "server/app/fleet/fleet_settings.hpp"
#include "server/store/map_file.hpp"

namespace seeker::app {
namespace {

constexpr std::size_t kMaxWaiting = 4096;  ///< pieces to be written and maps to be judged

ReportDamage damage_teller(const FleetHost& host) {
  return [notify_operator = host.notify_operator](const std::string& what) {
    log::warning(kFleetPart, what);
    notify_operator("fleet-memory-damaged", what, api::Severity::kWarning);
  };
}

}  // namespace

FleetLeader::FleetLeader(FleetLeaderParams params, FleetHost host)
    : params_(std::move(params)),
      pieces_(params_.folder),
      records_(params_.folder, pieces_, damage_teller(host)),
      memory_(params_.folder, params_.robot_id, pieces_, damage_teller(host)),
      main_(params_.robot_id),
      book_({params_.silence_limit, params_.retry_period}, main_, errands(host)),
      judge_(params_.merge, params_.retry_period, book_, main_, host.give_map),
      sharing_({params_.floor_period, params_.search_age}, book_, main_, std::move(host)),
      worker_(kMaxWaiting, "the fleet") {
  load();
}

FleetErrands FleetLeader::errands(const FleetHost& host) {
  FleetErrands errands;
  errands.keep_piece = [this](const std::string& robot_id, const api::PieceHash& hash, const PieceBytes& bytes) {
    // A full queue means that the disk cannot follow: the piece is sent again after a restart.
    static_cast<void>(worker_.post([this, robot_id, hash, bytes] { pieces_.keep(robot_id, hash, bytes); }));
  };
  errands.keep_record = [this](const std::string& robot_id) {
    const Status posted = worker_.post([this, robot_id] {
      book_.begin_record(robot_id);
      keep_record(robot_id);
    });
    return posted.has_value();
  };
  errands.judge = [this](const std::string& robot_id) {
    const Status posted = worker_.post([this, robot_id] {
      keep_record(robot_id);
      judge_.judge(robot_id);
      keep_memory();
    });
    return posted.has_value();
  };
  errands.notify_operator = host.notify_operator;
  return errands;
}

void FleetLeader::load() {
  std::optional<v1::KeptFleet> kept = memory_.read();
  book_.load(kept ? FleetMemory::slots_of(*kept) : FleetSlots(), records_.load(params_.robot_id));
  // What was found is laid out first, so that nobody who asks meanwhile is told that nothing is known.
  if (kept) {
    static_cast<void>(
        worker_.post([this, memory = std::make_shared<v1::KeptFleet>(std::move(*kept))] { recall(*memory); }));
  }
  book_.judge_complete();
}

void FleetLeader::recall(const v1::KeptFleet& kept) {
  judge_.recall(memory_.recall(kept));
  memory_.set_own_version(judge_.judged().own_version);
}

void FleetLeader::keep_record(const std::string& robot_id) {
  records_.keep(robot_id, [&] { return book_.record_of(robot_id); });
}

void FleetLeader::keep_memory() { memory_.keep(judge_.judged(), main_.report(), book_.slots()); }

Result<api::FleetAnswer> FleetLeader::announce(const api::FleetManifest& manifest) {
  return book_.announce(manifest, std::chrono::steady_clock::now());
}

Result<std::uint64_t> FleetLeader::receive(const api::FleetChunk& chunk) { return book_.receive(chunk); }

Result<api::FleetShared> FleetLeader::share(const api::FleetShare& share) { return sharing_.share(share); }

Result<api::FleetSightings> FleetLeader::seen(const api::FleetSeen& seen) { return sharing_.seen(seen); }

Result<api::FleetScene> FleetLeader::scene() const { return sharing_.scene(); }

void FleetLeader::refresh() {
  if (sharing_.refresh()) {
    // A full queue only delays it: it is written with the next judgement, too.
    static_cast<void>(worker_.post([this] { keep_memory(); }));
  }
}

api::FleetStatus FleetLeader::status() const { return book_.status(std::chrono::steady_clock::now()); }

Result<api::FleetStatus> FleetLeader::decide(const api::FleetDecision& decision) {
  Result<api::FleetStatus> decided = book_.decide(decision, std::chrono::steady_clock::now());
  if (decided) {
    keep_record(decision.robot_id);  // at once: nobody says it a second time
  }
  return decided;
}

void FleetLeader::map(const api::Reply<std::vector<std::uint8_t>>& reply) {
  const Status posted = worker_.post([this, reply] {
    const fleet::JointMap* joint = judge_.joint_map();
    if (joint == nullptr) {
      reply(fail(Errc::kNotReady, "no robot's map is merged with this one's yet; 'seeker fleet status' tells why"));
      return;
    }
    store::MapFile file;
    file.origin.name = "fleet";
    file.origin.robot_id = params_.robot_id;
    file.origin.software_version = params_.software_version;
    file.origin.saved_unix_s = wall_unix_s();
    file.origin.created_unix_s = file.origin.saved_unix_s;
    file.map = joint->map;
    store::MapFileLimits limits;
    limits.file_bytes = api::kMaxMapTransferBytes;
    reply(store::encode_map_file(file, limits));
  });
  if (!posted) {
    reply(tl::unexpected<Error>(posted.error()));
  }
}

}  // namespace seeker::app
