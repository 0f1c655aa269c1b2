#include "common/rpc/file_transfer.hpp"

#include <algorithm>
#include <future>
#include <thread>
#include <utility>

namespace seeker::rpc {
namespace {

constexpr Duration kPoll = std::chrono::milliseconds(50);
/// Of a piece on the slowest link: passes 3 s of silence at 44 kbit/s.
constexpr std::size_t kMinPiece_bytes = std::size_t{16} << 10U;
/// Times that the robot may have lost what it had; each costs the file once more.
constexpr int kMaxRestarts = 3;

bool passes(Errc code) { return code == Errc::kLinkLost || code == Errc::kTimeout || code == Errc::kBusy; }

}  // namespace

FileTransfer::FileTransfer(std::shared_ptr<api::RobotApi> robot, TransferParams params)
    : robot_(std::move(robot)),
      params_(std::move(params)),
      piece_bytes_(std::min(params_.piece_bytes, api::kMaxFilePiece_bytes)),
      progress_at_(Clock::now()) {}

template <class T>
Result<T> FileTransfer::once(const std::function<void(api::Reply<T>)>& call) {
  const auto promise = std::make_shared<std::promise<Result<T>>>();
  std::future<Result<T>> future = promise->get_future();
  call([promise](Result<T> result) { promise->set_value(std::move(result)); });
  while (future.wait_for(kPoll) != std::future_status::ready) {
    if (const std::optional<Error> error = params_.broken()) {
      return tl::unexpected<Error>(*error);
    }
  }
  return future.get();
}

template <class T>
Result<T> FileTransfer::until_answered(const std::function<void(api::Reply<T>)>& call) {
  for (;;) {
    Result<T> result = once<T>(call);
    if (result) {
      return result;
    }
    if (const Status go_on = pause_after(result.error()); !go_on) {
      return tl::unexpected<Error>(go_on.error());
    }
  }
}

Status FileTransfer::pause_after(const Error& error) {
  if (!passes(error.code)) {
    return tl::unexpected<Error>(error);
  }
  if (error.code != Errc::kBusy) {
    piece_bytes_ = std::max(piece_bytes_ / 2, std::min(kMinPiece_bytes, params_.piece_bytes));
  }
  if (Clock::now() - progress_at_ > params_.stall_limit) {
    return fail(error.code, "no byte has arrived for " +
                                std::to_string(static_cast<int>(to_seconds(params_.stall_limit))) +
                                " s: " + error.message);
  }
  if (const std::optional<Error> broken = params_.broken()) {
    return tl::unexpected<Error>(*broken);
  }
  std::this_thread::sleep_for(kPoll);
  return {};
}

void FileTransfer::arrived(std::uint64_t offset, std::uint64_t size_bytes) {
  if (offset > furthest_) {
    furthest_ = offset;
    progress_at_ = Clock::now();
  }
  params_.on_progress(offset, size_bytes);
}

Result<std::uint64_t> FileTransfer::begin(const api::FileOffer& offer) {
  Result<std::uint64_t> have = until_answered<std::uint64_t>(
      [&](api::Reply<std::uint64_t> reply) { robot_->begin_upload(offer, std::move(reply)); });
  if (have && *have > offer.size_bytes) {
    return fail(Errc::kInternal, "the robot says that it has more of the file than there is");
  }
  if (have) {
    arrived(*have, offer.size_bytes);
  }
  return have;
}

Status FileTransfer::send(const api::FileOffer& offer, const Source& source) {
  furthest_ = 0;
  progress_at_ = Clock::now();
  Result<std::uint64_t> offset = begin(offer);
  for (int restarts = 0; offset && *offset < offer.size_bytes;) {
    Result<std::vector<std::uint8_t>> bytes = source(*offset, piece_bytes_);
    if (!bytes) {
      return tl::unexpected<Error>(bytes.error());
    }
    if (bytes->empty()) {
      return fail(Errc::kIo, "the file became shorter while it was sent; send it again");
    }
    const api::UploadPiece piece{offer.hash, *offset, std::move(*bytes)};
    const Result<std::uint64_t> have =
        once<std::uint64_t>([&](api::Reply<std::uint64_t> reply) { robot_->upload_piece(piece, std::move(reply)); });
    if (have && *have > *offset && *have <= offer.size_bytes) {
      offset = have;
      piece_bytes_ = std::min(2 * piece_bytes_, std::min(params_.piece_bytes, api::kMaxFilePiece_bytes));
      arrived(*offset, offer.size_bytes);
      continue;
    }
    const bool lost = have || have.error().code == Errc::kNotFound || have.error().code == Errc::kRefused;
    if (lost && ++restarts > kMaxRestarts) {
      return fail(Errc::kInternal, "the robot has lost what it had of the file again and again; try again later");
    }
    if (!lost) {
      if (const Status go_on = pause_after(have.error()); !go_on) {
        return go_on;
      }
    }
    offset = begin(offer);
  }
  return offset ? Status() : Status(tl::unexpected<Error>(offset.error()));
}

Result<api::UploadedFile> FileTransfer::finish(const api::UploadEnd& end) {
  progress_at_ = Clock::now();
  return until_answered<api::UploadedFile>(
      [&](api::Reply<api::UploadedFile> reply) { robot_->finish_upload(end, std::move(reply)); });
}

Result<api::FilePiece> FileTransfer::look(api::FileKind kind, const std::string& name) {
  progress_at_ = Clock::now();
  const api::FileRead wish{kind, name, 0, 0, std::nullopt};
  return until_answered<api::FilePiece>(
      [&](api::Reply<api::FilePiece> reply) { robot_->read_file(wish, std::move(reply)); });
}

Status FileTransfer::receive(api::FileRead from, const api::FilePiece& file, const Sink& sink) {
  furthest_ = 0;
  progress_at_ = Clock::now();
  from.hash = file.hash;
  arrived(from.offset, file.size_bytes);
  while (from.offset < file.size_bytes) {
    const Result<api::FilePiece> piece = until_answered<api::FilePiece>([&](api::Reply<api::FilePiece> reply) {
      from.max_bytes = static_cast<std::uint32_t>(piece_bytes_);
      robot_->read_file(from, std::move(reply));
    });
    if (!piece) {
      return tl::unexpected<Error>(piece.error());
    }
    if (piece->hash != file.hash || piece->bytes.empty() || piece->bytes.size() > file.size_bytes - from.offset) {
      return fail(Errc::kInternal, "the robot sent bytes that are not of the file; fetch it again");
    }
    if (const Status kept = sink(from.offset, piece->bytes); !kept) {
      return kept;
    }
    from.offset += piece->bytes.size();
    piece_bytes_ = std::min(2 * piece_bytes_, std::min(params_.piece_bytes, api::kMaxFilePiece_bytes));
    arrived(from.offset, file.size_bytes);
  }
  return {};
}

}  // namespace seeker::rpc
