// The calls of the remote client about maps of segments.

#include <utility>

#include "common/rpc/answers.hpp"
#include "common/rpc/client_impl.hpp"

namespace seeker::rpc {
namespace {

/// The reply of a call that answers with a summary; `result` picks the call's result out of the response.
template <class PickResult>
wire::ClientSession::Answer summary_answer(api::Reply<api::MapSummary> reply, PickResult result) {
  return value_answer<api::MapSummary>(std::move(reply), [result](const Responses& r) {
    return wire::from_message<api::MapSummary>(result(r.front()).map());
  });
}

Result<api::SegmentUpdate> join_segments(const Responses& parts) {
  api::SegmentUpdate all;
  for (const pb::Response& part : parts) {
    Result<api::SegmentUpdate> one = wire::from_message<api::SegmentUpdate>(part.get_segments().update());
    if (!one) {
      return one;
    }
    if (all.changed.size() + one->changed.size() > api::kMaxSegmentsOfMap) {
      return fail(Errc::kTooLarge, "the map has too many segments");
    }
    all.revision = one->revision;
    all.map_epoch = one->map_epoch;
    all.full = all.full || one->full;
    all.changed.insert(all.changed.end(), one->changed.begin(), one->changed.end());
    all.removed.insert(all.removed.end(), one->removed.begin(), one->removed.end());
  }
  return all;
}

}  // namespace

void RobotClient::get_segments(std::uint64_t since_revision, api::Reply<api::SegmentUpdate> reply) {
  pb::Request request;
  request.mutable_get_segments()->set_since_revision(since_revision);
  impl_->call(std::move(request), value_answer<api::SegmentUpdate>(std::move(reply), join_segments));
}

void RobotClient::save_map(const std::string& name, bool replace, api::Reply<api::MapSummary> reply) {
  pb::Request request;
  request.mutable_save_map()->set_name(wire::clean_text(name));
  request.mutable_save_map()->set_replace(replace);
  impl_->call(std::move(request), summary_answer(std::move(reply), [](const pb::Response& r) { return r.save_map(); }));
}

void RobotClient::load_map(const std::string& name, api::MapUse use, api::Reply<api::MapSummary> reply) {
  pb::Request request;
  request.mutable_load_map()->set_name(wire::clean_text(name));
  request.mutable_load_map()->set_use(static_cast<pb::MapUse>(wire::wire_enum(use)));
  impl_->call(std::move(request), summary_answer(std::move(reply), [](const pb::Response& r) { return r.load_map(); }));
}

void RobotClient::list_maps(api::Reply<std::vector<api::MapSummary>> reply) {
  pb::Request request;
  request.mutable_list_maps();
  impl_->call(std::move(request), value_answer<std::vector<api::MapSummary>>(std::move(reply), [](const Responses& r) {
                return read_list<api::MapSummary>(r.front().list_maps().maps(), api::kMaxMaps);
              }));
}

void RobotClient::inspect_map(const std::string& name, bool verify, api::Reply<api::MapSummary> reply) {
  pb::Request request;
  request.mutable_inspect_map()->set_name(wire::clean_text(name));
  request.mutable_inspect_map()->set_verify(verify);
  impl_->call(std::move(request),
              summary_answer(std::move(reply), [](const pb::Response& r) { return r.inspect_map(); }));
}

void RobotClient::delete_map(const std::string& name, api::Reply<void> reply) {
  pb::Request request;
  request.mutable_delete_map()->set_name(wire::clean_text(name));
  impl_->call(std::move(request), empty_answer(std::move(reply)));
}

void RobotClient::download_map(const std::string& name, api::Reply<std::vector<std::uint8_t>> reply) {
  pb::Request request;
  request.mutable_download_map()->set_name(wire::clean_text(name));
  impl_->call(std::move(request), value_answer<std::vector<std::uint8_t>>(std::move(reply), [](const Responses& r) {
                const std::string& file = r.front().download_map().file();
                return Result<std::vector<std::uint8_t>>(std::vector<std::uint8_t>(file.begin(), file.end()));
              }));
}

void RobotClient::upload_map(const api::MapUpload& upload, api::Reply<api::MapSummary> reply) {
  pb::Request request;
  pb::UploadMapRequest* to = request.mutable_upload_map();
  to->set_name(wire::clean_text(upload.name));
  to->mutable_file()->assign(upload.bytes.begin(), upload.bytes.end());
  to->set_replace(upload.replace);
  to->set_check_only(upload.check_only);
  impl_->call(std::move(request),
              summary_answer(std::move(reply), [](const pb::Response& r) { return r.upload_map(); }));
}

void RobotClient::relocalise(const std::optional<Pose2>& map_T_base, api::Reply<void> reply) {
  pb::Request request;
  pb::RelocaliseRequest* to = request.mutable_relocalise();
  if (map_T_base) {
    wire::write(*map_T_base, to->mutable_map_t_base());
  }
  impl_->call(std::move(request), empty_answer(std::move(reply)));
}

}  // namespace seeker::rpc
