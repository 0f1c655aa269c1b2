#include "server/app/robot/map_service.hpp"

#include <span>
#include <utility>

#include "common/files/files.hpp"
#include "server/fleet/joint_map.hpp"

namespace seeker::app {
namespace {

api::MapSummary summary_of(const store::MapListing& listing) {
  const store::MapFileHeader& header = listing.header;
  return {.name = header.origin.name,
          .robot_id = header.origin.robot_id,
          .sensors = header.origin.sensors,
          .software_version = header.origin.software_version,
          .created_unix_s = header.origin.created_unix_s,
          .saved_unix_s = header.origin.saved_unix_s,
          .file_bytes = listing.file_bytes,
          .epoch = header.epoch,
          .nodes = header.nodes,
          .edges = header.edges,
          .loops = header.loops,
          .segments = header.segments,
          .keyframes = header.keyframes,
          .problem = listing.problem};
}

Result<api::MapSummary> summary_of(const Result<store::MapListing>& listing) {
  return listing ? Result<api::MapSummary>(summary_of(*listing))
                 : Result<api::MapSummary>(tl::unexpected<Error>(listing.error()));
}

Error with_disk_remedy(const Error& error) {
  return error.code == Errc::kIo ? Error{error.code, error.message + "; free space on the disk of the state folder"}
                                 : error;
}

/// What an upload has brought, under its name; of the present file where that is the same already.
Result<api::MapSummary> kept_map(const store::MapFiles& files, std::span<const std::uint8_t> bytes,
                                 const std::string& name, bool replace, bool check_only) {
  Result<store::MapFile> file = store::decode_map_file(bytes);
  if (!file) {
    return tl::unexpected<Error>(file.error());
  }
  if (check_only) {
    return summary_of(
        store::MapListing{store::decode_map_header(bytes).value_or(store::MapFileHeader()), bytes.size(), ""});
  }
  file->origin.name = name;
  const Result<store::MapFile> present = files.read(name);
  if (present && *present == *file) {
    return summary_of(files.inspect(name));
  }
  const Result<store::MapListing> written = files.write(*file, replace);
  return written ? summary_of(*written)
                 : Result<api::MapSummary>(tl::unexpected<Error>(with_disk_remedy(written.error())));
}

}  // namespace

MapService::MapService(MapStore& store, RobotLoop& loop, Mailbox& mailbox)
    : store_(store), loop_(loop), mailbox_(mailbox) {}

MapService::~MapService() { store_.finish(); }

template <class T>
void MapService::on_worker(const api::Reply<T>& reply, std::function<Result<T>(const store::MapFiles&)> work) {
  const Status ok = store_.post([reply, work = std::move(work)](const store::MapFiles& files) { reply(work(files)); });
  if (!ok) {
    reply(tl::unexpected<Error>(ok.error()));
  }
}

void MapService::save(const std::string& name, bool replace, const api::Reply<api::MapSummary>& reply) {
  const bool posted = mailbox_.post([this, name, replace, reply] {
    Result<LoopMap> map = loop_.maps().to_save(name);
    if (!map) {
      reply(tl::unexpected<Error>(map.error()));
      return;
    }
    // Saving again under its own name is how a map grows.
    const bool own = map->identity.name == name;
    const auto shared = std::make_shared<const LoopMap>(std::move(*map));
    const Status ok = store_.post([this, shared, name, replace, own, reply](const store::MapFiles& files) {
      write(files, *shared, name, replace || own, reply);
    });
    if (!ok) {
      reply(tl::unexpected<Error>(ok.error()));
    }
  });
  if (!posted) {
    reply(fail(Errc::kBusy, "the robot is overloaded or shutting down; try again"));
  }
}

void MapService::write(const store::MapFiles& files, const LoopMap& from, const std::string& name, bool replace,
                       const api::Reply<api::MapSummary>& reply) {
  const store::MapFile file = store_.file_of(from, name);
  const Result<store::MapListing> written = files.write(file, replace);
  if (!written) {
    reply(tl::unexpected<Error>(with_disk_remedy(written.error())));
    return;
  }
  // The answer comes after the loop knows the name, so that a status asked for next has it.
  const MapIdentity identity{name, file.origin.created_unix_s, api::MapUse::kContinue};
  const api::MapSummary summary = summary_of(*written);
  if (!mailbox_.post([this, identity, reply, summary] {
        loop_.maps().saved(identity);
        reply(summary);
      })) {
    reply(summary);  // the robot shuts down; the file is there
  }
}

void MapService::load(const std::string& name, api::MapUse use, const api::Reply<api::MapSummary>& reply) {
  const Status ok = store_.post([this, name, use, reply](const store::MapFiles& files) {
    Result<store::MapFile> file = files.read(name);
    const Result<store::MapListing> listing = files.inspect(name);
    if (!file || !listing) {
      reply(tl::unexpected<Error>(file ? listing.error() : file.error()));
      return;
    }
    file->map = fleet::as_one_robots(std::move(file->map));  // a fleet's map, too, may be carried on by one robot
    const auto shared = std::make_shared<const store::MapFile>(std::move(*file));
    const bool posted = mailbox_.post([this, shared, name, use, summary = summary_of(*listing), reply] {
      const Status loaded = loop_.commands().load_map(shared->map, {name, shared->origin.created_unix_s, use});
      reply(loaded ? Result<api::MapSummary>(summary) : tl::unexpected<Error>(loaded.error()));
    });
    if (!posted) {
      reply(fail(Errc::kBusy, "the robot is overloaded or shutting down; try again"));
    }
  });
  if (!ok) {
    reply(tl::unexpected<Error>(ok.error()));
  }
}

void MapService::list(const api::Reply<std::vector<api::MapSummary>>& reply) {
  on_worker<std::vector<api::MapSummary>>(reply,
                                          [](const store::MapFiles& files) -> Result<std::vector<api::MapSummary>> {
                                            const Result<std::vector<store::MapListing>> listings = files.list();
                                            if (!listings) {
                                              return tl::unexpected<Error>(listings.error());
                                            }
                                            std::vector<api::MapSummary> maps;
                                            for (const store::MapListing& listing : *listings) {
                                              maps.push_back(summary_of(listing));
                                            }
                                            return maps;
                                          });
}

void MapService::inspect(const std::string& name, bool verify, const api::Reply<api::MapSummary>& reply) {
  on_worker<api::MapSummary>(reply, [name, verify](const store::MapFiles& files) -> Result<api::MapSummary> {
    if (verify) {
      if (const Result<store::MapFile> file = files.read(name); !file) {
        return tl::unexpected<Error>(file.error());
      }
    }
    return summary_of(files.inspect(name));
  });
}

void MapService::remove(const std::string& name, const api::Reply<void>& reply) {
  const bool posted = mailbox_.post([this, name, reply] {
    if (const Status free = loop_.maps().not_in_use(name); !free) {
      reply(free);
      return;
    }
    on_worker<void>(reply, [name](const store::MapFiles& files) { return files.remove(name); });
  });
  if (!posted) {
    reply(fail(Errc::kBusy, "the robot is overloaded or shutting down; try again"));
  }
}

void MapService::download(const std::string& name, const api::Reply<std::vector<std::uint8_t>>& reply) {
  on_worker<std::vector<std::uint8_t>>(
      reply, [name](const store::MapFiles& files) -> Result<std::vector<std::uint8_t>> {
        Result<std::vector<std::uint8_t>> bytes = files.read_bytes(name);
        if (bytes && bytes->size() > api::kMaxMapTransferBytes) {
          return fail(Errc::kTooLarge, "map '" + name + "' has " + std::to_string(bytes->size()) +
                                           " bytes, more than the 15 MiB that can be sent; copy the file '" +
                                           files.path_of(name).string() + "'");
        }
        return bytes;
      });
}

void MapService::upload(const api::MapUpload& upload, const api::Reply<api::MapSummary>& reply) {
  const auto bytes = std::make_shared<const std::vector<std::uint8_t>>(upload.bytes);
  keep(
      upload.name, upload.replace, upload.check_only, [bytes] { return Result<std::vector<std::uint8_t>>(*bytes); },
      reply);
}

void MapService::take(const std::filesystem::path& file, const api::UploadEnd& end,
                      const api::Reply<api::MapSummary>& reply) {
  keep(
      end.name, end.replace, end.check_only,
      [file] { return files::read_file(file, store::MapFileLimits().file_bytes); }, reply);
}

void MapService::keep(const std::string& name, bool replace, bool check_only,
                      const std::function<Result<std::vector<std::uint8_t>>()>& fetch,
                      const api::Reply<api::MapSummary>& reply) {
  const bool posted = mailbox_.post([this, name, replace, check_only, fetch, reply] {
    if (const Status free = check_only ? Status() : loop_.maps().not_in_use(name); !free) {
      reply(tl::unexpected<Error>(free.error()));
      return;
    }
    on_worker<api::MapSummary>(
        reply, [name, replace, check_only, fetch](const store::MapFiles& files) -> Result<api::MapSummary> {
          const Result<std::vector<std::uint8_t>> bytes = fetch();
          return bytes ? kept_map(files, *bytes, name, replace, check_only)
                       : Result<api::MapSummary>(tl::unexpected<Error>(bytes.error()));
        });
  });
  if (!posted) {
    reply(fail(Errc::kBusy, "the robot is overloaded or shutting down; try again"));
  }
}

void MapService::read(const api::FileRead& wish, const api::Reply<api::FilePiece>& reply) {
  on_worker<api::FilePiece>(reply, [this, wish](const store::MapFiles& files) -> Result<api::FilePiece> {
    if (const Status there = files.check_present(wish.name); !there) {
      return tl::unexpected<Error>(there.error());
    }
    Result<store::OutgoingPiece> piece =
        outgoing_.read(files.path_of(wish.name), {wish.offset, wish.max_bytes, wish.hash}, [&] {
          const Result<store::MapFile> sound = files.read(wish.name);
          return sound ? Status() : Status(tl::unexpected<Error>(sound.error()));
        });
    if (!piece) {
      return tl::unexpected<Error>(piece.error());
    }
    return api::FilePiece{piece->hash, piece->size_bytes, std::move(piece->bytes)};
  });
}

}  // namespace seeker::app
