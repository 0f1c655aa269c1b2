// Maps of missions that are building them, for their resumption after a crash.

#include <utility>

#include "server/app/map_service.hpp"

namespace seeker::app {

void MapService::write_checkpoint(const api::MissionId& mission, LoopMap map) {
  const auto shared = std::make_shared<const LoopMap>(std::move(map));
  const auto answer = [this](const Status& written) {
    // A robot that shuts down needs no answer.
    static_cast<void>(mailbox_.post([this, written] { loop_.checkpoint_written(written); }));
  };
  const Status ok = enqueue([this, mission, shared, answer](const store::MapFiles& /*files*/) {
    const Result<store::MapListing> written = checkpoints_.write(file_of(*shared, mission), true);
    answer(written ? Status() : Status(tl::unexpected<Error>(written.error())));
  });
  if (!ok) {
    answer(ok);
  }
}

void MapService::drop_checkpoints() {
  // Where they cannot be removed they do no harm: they are looked up by the id of their mission.
  static_cast<void>(enqueue([this](const store::MapFiles& /*files*/) {
    const Result<std::vector<store::MapListing>> kept = checkpoints_.list();
    for (const store::MapListing& listing : kept ? *kept : std::vector<store::MapListing>()) {
      static_cast<void>(checkpoints_.remove(listing.header.origin.name));
    }
  }));
}

void MapService::resume_mission(const api::Reply<void>& reply) {
  const bool posted = mailbox_.post([this, reply] {
    const std::optional<api::MissionId> mission = loop_.checkpoint_to_resume();
    if (mission && !storage_.folder.empty()) {
      resume_from(*mission, reply);
    } else {
      reply(loop_.command_mission(api::MissionCommand::kResume));
    }
  });
  if (!posted) {
    reply(fail(Errc::kBusy, "the robot is overloaded or shutting down; try again"));
  }
}

void MapService::resume_from(const api::MissionId& mission, const api::Reply<void>& reply) {
  const Status ok = enqueue([this, mission, reply](const store::MapFiles& /*files*/) {
    Result<store::MapFile> file = checkpoints_.read(mission);
    const MapIdentity identity{"", file ? file->origin.created_unix_s : 0, api::MapUse::kContinue};
    const auto map = std::make_shared<const Result<LineMap>>(
        file ? Result<LineMap>(std::move(file->map)) : Result<LineMap>(tl::unexpected<Error>(file.error())));
    const bool posted = mailbox_.post([this, map, identity, reply] { reply(loop_.resume_in_map(*map, identity)); });
    if (!posted) {
      reply(fail(Errc::kBusy, "the robot is overloaded or shutting down; try again"));
    }
  });
  if (!ok) {
    reply(ok);
  }
}

}  // namespace seeker::app
