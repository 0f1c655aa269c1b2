#include "server/app/robot/checkpoint_service.hpp"

#include <utility>

#include "server/app/state/kept_files.hpp"

namespace seeker::app {
namespace {

/// Of a map that a mission could not go on in; the first free number is taken.
std::string name_aside(const api::MissionId& mission, int number) {
  constexpr std::size_t kMaxName = 48;
  return mission.substr(0, kMaxName) + "-cut-off" + (number > 1 ? "-" + std::to_string(number) : "");
}

}  // namespace

CheckpointService::CheckpointService(MapStore& store, RobotLoop& loop, Mailbox& mailbox)
    : store_(store), loop_(loop), mailbox_(mailbox), folder_(store.checkpoint_folder()), files_(folder_) {}

CheckpointService::~CheckpointService() { store_.finish(); }

void CheckpointService::write(const api::MissionId& mission, Checkpoint checkpoint) {
  const auto shared = std::make_shared<const Checkpoint>(std::move(checkpoint));
  const auto answer = [this](const Status& written) {
    // A robot that shuts down needs no answer.
    static_cast<void>(mailbox_.post([this, written] { loop_.mission_control().checkpoints().written(written); }));
  };
  const Status ok = store_.post([this, mission, shared, answer](const store::MapFiles& /*files*/) {
    // First, so that no map is without one; a full disk is told with the map.
    static_cast<void>(keep_place(folder_, mission, shared->place));
    const Result<store::MapListing> written = files_.write(store_.file_of(shared->map, mission), true);
    Status kept = written ? Status() : Status(tl::unexpected<Error>(written.error()));
    // After the map: what is remembered of an older one is less, and never of places that the map does not have.
    if (kept) {
      kept = keep_memory(folder_, mission, shared->memory, shared->map.map.epoch);
    }
    answer(kept);
  });
  if (!ok) {
    answer(ok);
  }
}

void CheckpointService::write_place(const api::MissionId& mission, const MissionPlace& place) {
  const auto answer = [this] {
    static_cast<void>(mailbox_.post([this] { loop_.mission_control().checkpoints().place_written(); }));
  };
  const Status ok = store_.post([this, mission, place, answer](const store::MapFiles& /*files*/) {
    static_cast<void>(keep_place(folder_, mission, place));  // a full disk is told with the map
    answer();
  });
  if (!ok) {
    answer();
  }
}

void CheckpointService::set_aside(const api::MissionId& mission) {
  static_cast<void>(store_.post([this, mission](const store::MapFiles& files) {
    Result<store::MapFile> file = files_.read(mission);
    Result<store::MapListing> saved = fail(Errc::kNotFound, "there is no map");
    constexpr int kMostNames = 100;
    for (int k = 1; file && !saved && k <= kMostNames; ++k) {
      file->origin.name = name_aside(mission, k);
      saved = files.write(*file, false);
    }
    const std::string text = saved ? "the map that the robot was not found in is saved as '" + file->origin.name + "'"
                                   : "the map that the robot was not found in could not be saved: " +
                                         (file ? saved.error() : file.error()).message;
    report("map-set-aside", text, saved ? api::Severity::kInfo : api::Severity::kWarning);
  }));
}

void CheckpointService::report(const std::string& kind, const std::string& text, api::Severity severity) {
  static_cast<void>(mailbox_.post([this, kind, text, severity] { loop_.diagnostics().log(kind, text, severity); }));
}

void CheckpointService::drop() {
  // Where they cannot be removed they do no harm: they are looked up by the id of their mission.
  static_cast<void>(store_.post([this](const store::MapFiles& /*files*/) {
    const Result<std::vector<store::MapListing>> kept = files_.list();
    for (const store::MapListing& listing : kept ? *kept : std::vector<store::MapListing>()) {
      static_cast<void>(files_.remove(listing.header.origin.name));
    }
    drop_kept(folder_);
  }));
}

void CheckpointService::resume_mission(const std::string& client, const StillWanted& still_wanted,
                                       const api::Reply<void>& reply) {
  const bool posted = mailbox_.post([this, client, still_wanted, reply] {
    if (const Status wanted = still_wanted(); !wanted) {
      reply(wanted);
      return;
    }
    const std::optional<api::MissionId> mission = loop_.mission_control().checkpoint_to_resume();
    if (mission && store_.has_folder()) {
      resume_from(*mission, client, still_wanted, reply);
    } else {
      reply(loop_.commands().command_mission(api::MissionCommand::kResume, client));
    }
  });
  if (!posted) {
    reply(fail(Errc::kBusy, "the robot is overloaded or shutting down; try again"));
  }
}

void CheckpointService::resume_from(const api::MissionId& mission, const std::string& client,
                                    const StillWanted& still_wanted, const api::Reply<void>& reply) {
  const Status ok = store_.post([this, mission, client, still_wanted, reply](const store::MapFiles& /*files*/) {
    Result<store::MapFile> file = files_.read(mission);
    const MapIdentity identity{"", file ? file->origin.created_unix_s : 0, api::MapUse::kContinue};
    std::string trouble;
    const KeptState kept = file ? read_kept(folder_, mission, file->map.epoch, trouble) : KeptState{};
    if (!trouble.empty()) {
      report("resume-without-memory", "the mission goes on in its map, but without all that it remembered: " + trouble,
             api::Severity::kWarning);
    }
    const auto map = std::make_shared<const Result<LineMap>>(
        file ? Result<LineMap>(std::move(file->map)) : Result<LineMap>(tl::unexpected<Error>(file.error())));
    const bool posted = mailbox_.post([this, map, identity, client, kept, still_wanted, reply] {
      const Status wanted = still_wanted();
      reply(wanted ? loop_.mission_control().resume_in_map(*map, identity, client, kept) : wanted);
    });
    if (!posted) {
      reply(fail(Errc::kBusy, "the robot is overloaded or shutting down; try again"));
    }
  });
  if (!ok) {
    reply(ok);
  }
}

}  // namespace seeker::app
