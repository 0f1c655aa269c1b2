// The calls about maps of segments: files of the robot, relocalisation, changes of segments.

#include "server/net/responder.hpp"

namespace seeker::server_net {
namespace {

/// The reply of a call whose answer is the summary of a map; `field` is its place in the response.
template <class Field>
api::Reply<api::MapSummary> reply_summary(const Responder& responder, Field field) {
  return reply_with<api::MapSummary>(responder, [field](const api::MapSummary& summary, pb::Response& to) {
    wire::write(summary, field(to)->mutable_map());
  });
}

void load_map(const Responder& responder, Session& session, const pb::LoadMapRequest& request) {
  wire::Check check;
  api::MapUse use = api::MapUse::kContinue;
  check.enumerator("use", request.use(), api::MapUse::kLocalise, use);
  if (!check.ok()) {
    responder.answer_now(check.status());
    return;
  }
  with_name(responder, request.name(), [&] {
    session.robot().load_map(request.name(), use,
                             reply_summary(responder, [](pb::Response& to) { return to.mutable_load_map(); }));
  });
}

void upload_map(const Responder& responder, Session& session, const pb::UploadMapRequest& request) {
  if (request.file().size() > api::kMaxMapTransferBytes) {
    responder.answer_now(
        fail(Errc::kTooLarge, "field 'file' has more than 15 MiB; copy the file to the robot instead"));
    return;
  }
  with_name(responder, request.name(), [&] {
    api::MapUpload upload;
    upload.name = request.name();
    upload.bytes.assign(request.file().begin(), request.file().end());
    upload.replace = request.replace();
    upload.check_only = request.check_only();
    session.robot().upload_map(upload,
                               reply_summary(responder, [](pb::Response& to) { return to.mutable_upload_map(); }));
  });
}

void download_map(const Responder& responder, Session& session, const pb::DownloadMapRequest& request) {
  with_name(responder, request.name(), [&] {
    session.robot().download_map(
        request.name(),
        reply_with<std::vector<std::uint8_t>>(responder, [](const std::vector<std::uint8_t>& bytes, pb::Response& to) {
          to.mutable_download_map()->mutable_file()->assign(bytes.begin(), bytes.end());
        }));
  });
}

void list_maps(const Responder& responder, Session& session) {
  session.robot().list_maps(reply_with<std::vector<api::MapSummary>>(
      responder, [](const std::vector<api::MapSummary>& maps, pb::Response& to) {
        for (const api::MapSummary& map : maps) {
          wire::write(map, to.mutable_list_maps()->add_maps());
        }
      }));
}

void relocalise(const Responder& responder, Session& session, const pb::RelocaliseRequest& request) {
  std::optional<Pose2> map_T_base;
  if (request.has_map_t_base()) {
    const Result<Pose2> pose = wire::from_message<Pose2>(request.map_t_base());
    if (!pose) {
      responder.answer_now(status_of(pose));
      return;
    }
    map_T_base = *pose;
  }
  session.robot().relocalise(map_T_base, reply_empty(responder));
}

/// Large maps leave in several responses.
void answer_segments(const Responder& responder, const Result<api::SegmentUpdate>& result) {
  const SessionPtr to = responder.session.lock();
  if (!to) {
    return;
  }
  if (!result) {
    responder.answer_now(status_of(result));
    return;
  }
  const std::vector<api::SegmentUpdate> parts = api::split(*result);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    pb::Response response = responder.begin(*to, {});
    response.mutable_get_segments()->set_part(static_cast<std::uint32_t>(k + 1));
    response.mutable_get_segments()->set_parts(static_cast<std::uint32_t>(parts.size()));
    wire::write(parts[k], response.mutable_get_segments()->mutable_update());
    to->respond(response, responder.call, k + 1 == parts.size());
  }
}

void get_segments(const Responder& responder, Session& session, const pb::GetSegmentsRequest& request) {
  session.robot().get_segments(request.since_revision(), [responder](Result<api::SegmentUpdate> result) {
    boost::asio::post(*responder.io, [responder, result = std::move(result)] { answer_segments(responder, result); });
  });
}

}  // namespace

bool handle_map_call(const Responder& responder, Session& session, const pb::Request& request) {
  using R = pb::Request;
  api::RobotApi& robot = session.robot();
  switch (request.call_case()) {
    case R::kSaveMap:
      with_name(responder, request.save_map().name(), [&] {
        robot.save_map(request.save_map().name(), request.save_map().replace(),
                       reply_summary(responder, [](pb::Response& to) { return to.mutable_save_map(); }));
      });
      return true;
    case R::kInspectMap:
      with_name(responder, request.inspect_map().name(), [&] {
        robot.inspect_map(request.inspect_map().name(), request.inspect_map().verify(),
                          reply_summary(responder, [](pb::Response& to) { return to.mutable_inspect_map(); }));
      });
      return true;
    case R::kDeleteMap:
      with_name(responder, request.delete_map().name(),
                [&] { robot.delete_map(request.delete_map().name(), reply_empty(responder)); });
      return true;
    case R::kLoadMap: load_map(responder, session, request.load_map()); return true;
    case R::kListMaps: list_maps(responder, session); return true;
    case R::kDownloadMap: download_map(responder, session, request.download_map()); return true;
    case R::kUploadMap: upload_map(responder, session, request.upload_map()); return true;
    case R::kRelocalise: relocalise(responder, session, request.relocalise()); return true;
    case R::kGetSegments: get_segments(responder, session, request.get_segments()); return true;
    default: return false;
  }
}

}  // namespace seeker::server_net
