// The calls of the remote client about files that travel in pieces.

#include <utility>

#include "common/rpc/answers.hpp"
#include "common/rpc/client_impl.hpp"

namespace seeker::rpc {
namespace {

/// The robot hashes and checks whole files before some of these answers. That the link is lost is noticed long before.
constexpr Duration kFileTime = std::chrono::minutes(1);

}  // namespace

void RobotClient::begin_upload(const api::FileOffer& offer, api::Reply<std::uint64_t> reply) {
  pb::Request request;
  wire::write(offer, request.mutable_begin_upload());
  impl_->call(std::move(request),
              value_answer<std::uint64_t>(
                  std::move(reply),
                  [](const Responses& r) { return Result<std::uint64_t>(r.front().begin_upload().offset()); }),
              kFileTime);
}

void RobotClient::upload_piece(const api::UploadPiece& piece, api::Reply<std::uint64_t> reply) {
  pb::Request request;
  wire::write(piece, request.mutable_upload_piece());
  impl_->call(std::move(request),
              value_answer<std::uint64_t>(
                  std::move(reply),
                  [](const Responses& r) { return Result<std::uint64_t>(r.front().upload_piece().offset()); }),
              kFileTime);
}

void RobotClient::finish_upload(const api::UploadEnd& end, api::Reply<api::UploadedFile> reply) {
  pb::Request request;
  wire::write(end, request.mutable_finish_upload());
  impl_->call(std::move(request),
              value_answer<api::UploadedFile>(
                  std::move(reply),
                  [](const Responses& r) { return wire::from_message<api::UploadedFile>(r.front().finish_upload()); }),
              kFileTime);
}

void RobotClient::read_file(const api::FileRead& wish, api::Reply<api::FilePiece> reply) {
  pb::Request request;
  wire::write(wish, request.mutable_read_file());
  impl_->call(std::move(request),
              value_answer<api::FilePiece>(
                  std::move(reply),
                  [](const Responses& r) { return wire::from_message<api::FilePiece>(r.front().read_file()); }),
              kFileTime);
}

}  // namespace seeker::rpc
