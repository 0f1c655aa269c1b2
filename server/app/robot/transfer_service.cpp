#include "server/app/robot/transfer_service.hpp"

#include <utility>

#include "common/files/files.hpp"
#include "common/image/png.hpp"

namespace seeker::app {
namespace {

/// Waiting requests; each may hold a piece.
constexpr std::size_t kMaxWaitingRequests = 16;

Result<Image> picture_in(const std::filesystem::path& file) {
  const auto limit = static_cast<std::size_t>(api::max_file_bytes(api::FileKind::kPicture));
  const Result<std::vector<std::uint8_t>> bytes = files::read_file(file, limit);
  return bytes ? image::decode_png(*bytes) : Result<Image>(tl::unexpected<Error>(bytes.error()));
}

Result<Image> target_picture(const store::IncomingFiles& files, const api::TargetSpec& target) {
  const Result<std::filesystem::path> file = files.whole(*target.picture_hash);
  Result<Image> picture = file ? picture_in(*file) : Result<Image>(tl::unexpected<Error>(file.error()));
  return picture ? std::move(picture)
                 : fail_with_context("the picture of target '" + target.name + "'", picture.error());
}

Result<api::MissionRequest> with_pictures(const store::IncomingFiles& files, api::MissionRequest request) {
  if (std::vector<api::TargetSpec>* targets = api::targets_of(request.task)) {
    for (api::TargetSpec& target : *targets) {
      if (!target.picture_hash) {
        continue;
      }
      Result<Image> picture = target_picture(files, target);
      if (!picture) {
        return tl::unexpected<Error>(picture.error());
      }
      target.picture = std::move(*picture);
      target.picture_hash.reset();
    }
  }
  const Status valid = api::validate(request);
  return valid ? Result<api::MissionRequest>(std::move(request)) : tl::unexpected<Error>(valid.error());
}

}  // namespace

TransferService::TransferService(std::filesystem::path folder, MapService& maps, LandmarkService& landmarks)
    : folder_(std::move(folder)),
      maps_(maps),
      landmarks_(landmarks),
      files_(folder_),
      disk_(kMaxWaitingRequests, "files") {}

Status TransferService::post(std::function<void(store::IncomingFiles&)> work) {
  if (folder_.empty()) {
    return fail(Errc::kNotReady, "this robot has no folder for files that arrive; start it with --state FOLDER");
  }
  return disk_.post([this, work = std::move(work)] { work(files_); });
}

template <class T>
void TransferService::on_worker(const api::Reply<T>& reply, std::function<Result<T>(store::IncomingFiles&)> work) {
  const Status ok = post([reply, work = std::move(work)](store::IncomingFiles& files) { reply(work(files)); });
  if (!ok) {
    reply(tl::unexpected<Error>(ok.error()));
  }
}

void TransferService::begin(const api::FileOffer& offer, const api::Reply<std::uint64_t>& reply) {
  if (const Status valid = api::validate(offer); !valid) {
    reply(tl::unexpected<Error>(valid.error()));
    return;
  }
  on_worker<std::uint64_t>(reply,
                           [offer](store::IncomingFiles& files) { return files.begin(offer.hash, offer.size_bytes); });
}

void TransferService::append(const api::UploadPiece& piece, const api::Reply<std::uint64_t>& reply) {
  const auto shared = std::make_shared<const api::UploadPiece>(piece);
  on_worker<std::uint64_t>(reply, [shared](store::IncomingFiles& files) {
    return files.append(shared->hash, shared->offset, shared->bytes);
  });
}

void TransferService::finish(const api::UploadEnd& end, const api::Reply<api::UploadedFile>& reply) {
  const Status ok = post([this, end, reply](store::IncomingFiles& files) {
    const Result<std::filesystem::path> file = files.whole(end.hash);
    if (!file) {
      reply(tl::unexpected<Error>(file.error()));
      return;
    }
    hand_over(*file, end, reply);
  });
  if (!ok) {
    reply(tl::unexpected<Error>(ok.error()));
  }
}

void TransferService::hand_over(const std::filesystem::path& file, const api::UploadEnd& end,
                                const api::Reply<api::UploadedFile>& reply) {
  switch (end.kind) {
    case api::FileKind::kMap:
      return maps_.take(file, end, [reply](Result<api::MapSummary> map) {
        reply(map ? Result<api::UploadedFile>(api::UploadedFile{std::move(*map), {}})
                  : tl::unexpected<Error>(map.error()));
      });
    case api::FileKind::kLandmarks:
      return landmarks_.take(file, end, [reply](Result<api::LandmarkSummary> database) {
        reply(database ? Result<api::UploadedFile>(api::UploadedFile{{}, std::move(*database)})
                       : tl::unexpected<Error>(database.error()));
      });
    case api::FileKind::kPicture: {
      const Result<Image> picture = picture_in(file);
      return reply(picture ? Result<api::UploadedFile>(api::UploadedFile{}) : tl::unexpected<Error>(picture.error()));
    }
  }
}

void TransferService::read(const api::FileRead& wish, const api::Reply<api::FilePiece>& reply) {
  switch (wish.kind) {
    case api::FileKind::kMap: return maps_.read(wish, reply);
    case api::FileKind::kLandmarks: return landmarks_.read(wish, reply);
    case api::FileKind::kPicture: return reply(fail(Errc::kInvalidArgument, "pictures are not given out"));
  }
}

void TransferService::add_pictures(const api::MissionRequest& request, const api::Reply<api::MissionRequest>& reply) {
  const auto shared = std::make_shared<const api::MissionRequest>(request);
  on_worker<api::MissionRequest>(reply,
                                 [shared](store::IncomingFiles& files) { return with_pictures(files, *shared); });
}

}  // namespace seeker::app
