// The calls about files that travel in pieces.

#include "server/net/responder.hpp"

namespace seeker::server_net {
namespace {

/// Calls `go` with the value of a request; responds with the error where it is not valid.
template <class T, class Message, class Go>
void with_value(const Responder& responder, const Message& message, Go go) {
  const Result<T> value = wire::from_message<T>(message);
  if (value) {
    go(*value);
  } else {
    responder.answer_now(status_of(value));
  }
}

void begin_upload(const Responder& responder, api::RobotApi& robot, const pb::BeginUploadRequest& request) {
  with_value<api::FileOffer>(responder, request, [&](const api::FileOffer& offer) {
    robot.begin_upload(offer, reply_with<std::uint64_t>(responder, [](std::uint64_t offset, pb::Response& to) {
                         to.mutable_begin_upload()->set_offset(offset);
                       }));
  });
}

void upload_piece(const Responder& responder, api::RobotApi& robot, const pb::UploadPieceRequest& request) {
  with_value<api::UploadPiece>(responder, request, [&](const api::UploadPiece& piece) {
    robot.upload_piece(piece, reply_with<std::uint64_t>(responder, [](std::uint64_t offset, pb::Response& to) {
                         to.mutable_upload_piece()->set_offset(offset);
                       }));
  });
}

void finish_upload(const Responder& responder, api::RobotApi& robot, const pb::FinishUploadRequest& request) {
  with_value<api::UploadEnd>(responder, request, [&](const api::UploadEnd& end) {
    const auto finish = [&] {
      robot.finish_upload(end,
                          reply_with<api::UploadedFile>(responder, [](const api::UploadedFile& file, pb::Response& to) {
                            wire::write(file, to.mutable_finish_upload());
                          }));
    };
    if (end.kind == api::FileKind::kPicture) {
      finish();
    } else {
      with_name(responder, end.name, finish);
    }
  });
}

void read_file(const Responder& responder, api::RobotApi& robot, const pb::ReadFileRequest& request) {
  with_value<api::FileRead>(responder, request, [&](const api::FileRead& wish) {
    with_name(responder, wish.name, [&] {
      robot.read_file(wish, reply_with<api::FilePiece>(responder, [](const api::FilePiece& piece, pb::Response& to) {
                        wire::write(piece, to.mutable_read_file());
                      }));
    });
  });
}

}  // namespace

bool handle_transfer_call(const Responder& responder, Session& session, const pb::Request& request) {
  using R = pb::Request;
  api::RobotApi& robot = session.robot();
  switch (request.call_case()) {
    case R::kBeginUpload: begin_upload(responder, robot, request.begin_upload()); return true;
    case R::kUploadPiece: upload_piece(responder, robot, request.upload_piece()); return true;
    case R::kFinishUpload: finish_upload(responder, robot, request.finish_upload()); return true;
    case R::kReadFile: read_file(responder, robot, request.read_file()); return true;
    default: return false;
  }
}

}  // namespace seeker::server_net
