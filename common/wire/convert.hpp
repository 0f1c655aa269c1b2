/// \file
/// Conversion of values to messages and back. write() never fails: it cuts texts that are too long and replaces bytes
/// that are not UTF-8. read() checks all counts, numbers, enumerators and sizes, and its error names the field.
#pragma once

#include <string>
#include <string_view>

#include "common/api/robot_api.hpp"
#include "common/wire/check.hpp"
#include "seeker/v1/calls.pb.h"
#include "seeker/v1/session.pb.h"

namespace seeker::wire {

namespace pb = ::seeker::v1;

/// Cuts a text to `limit` bytes of valid UTF-8.
[[nodiscard]] std::string clean_text(std::string_view text, std::size_t limit = kMaxTextBytes);

/// As clean_text(), on one line: what others send goes into logs.
[[nodiscard]] std::string one_line(std::string_view text, std::size_t limit = kMaxTextBytes);

template <class E>
[[nodiscard]] int wire_enum(E value) {
  return static_cast<int>(value) + 1;
}

/// The places of a mission's end that could not be reached, as points and with their causes.
void write_unreachable(const std::vector<UnreachablePlace>& from, pb::MissionEnd* to);
void read_unreachable(const pb::MissionEnd& from, std::vector<UnreachablePlace>& to, Check& check);

void write(const Pose2& from, pb::Pose2* to);
void write(const Twist2& from, pb::Twist2* to);
void write(const Point2& from, pb::Point2* to);
void write(const std::vector<Point2>& from, pb::PointList* to);
void write(const std::vector<api::StampedPose>& from, pb::PoseList* to);
void read(const pb::Pose2& from, Pose2& to, Check& check);
void read(const pb::Twist2& from, Twist2& to, Check& check);
void read(const pb::Point2& from, Point2& to, Check& check);
void read(const pb::PointList& from, std::vector<Point2>& to, Check& check, std::size_t limit = kMaxListPoints);
/// Reads poses; stamps that the other side does not send are zero.
void read(const pb::PoseList& from, std::vector<api::StampedPose>& to, Check& check);

void write(const LaserScan& from, pb::LaserScan* to);
void write(const SonarScan& from, pb::SonarScan* to);
void write(const Image& from, pb::Image* to);
void write(const api::ImageFrame& from, pb::ImageFrame* to);
void read(const pb::LaserScan& from, LaserScan& to, Check& check);
void read(const pb::SonarScan& from, SonarScan& to, Check& check);
void read(const pb::Image& from, Image& to, Check& check);
void read(const pb::ImageFrame& from, api::ImageFrame& to, Check& check);

void write(const api::LineReport& from, pb::LineReport* to);
void read(const pb::LineReport& from, api::LineReport& to, Check& check);

void write(const OccupancyTile& from, pb::Tile* to);
void write(const api::TileUpdate& from, pb::TileUpdate* to);
void read(const pb::Tile& from, OccupancyTile& to, Check& check);
void read(const pb::TileUpdate& from, api::TileUpdate& to, Check& check);

void write(const MapSegment& from, pb::Segment* to);
/// Writes at most kMaxSegmentsPerUpdate entries, the most that one message may have: see api::split().
void write(const api::SegmentUpdate& from, pb::SegmentUpdate* to);
void write(const api::MapSummary& from, pb::MapSummary* to);
void write(const api::LineMapStatus& from, pb::LineMapStatus* to);
void read(const pb::Segment& from, MapSegment& to, Check& check);
void read(const pb::SegmentUpdate& from, api::SegmentUpdate& to, Check& check);
void read(const pb::MapSummary& from, api::MapSummary& to, Check& check);
void read(const pb::LineMapStatus& from, api::LineMapStatus& to, Check& check);

void write(const api::LandmarkSummary& from, pb::LandmarkSummary* to);
void write(const api::LandmarkPoint& from, pb::Landmark* to);
void read(const pb::LandmarkSummary& from, api::LandmarkSummary& to, Check& check);
void read(const pb::Landmark& from, api::LandmarkPoint& to, Check& check);

void write(const Grid<std::uint8_t>& from, pb::ByteGrid* to);
void write(const api::Detection& from, pb::Detection* to);
void write(const api::CoverageSummary& from, pb::CoverageSummary* to);
void write(const api::GridLists& from, pb::GridLists* to);
void write(const api::GridReport& from, pb::GridReport* to);
void read(const pb::ByteGrid& from, Grid<std::uint8_t>& to, Check& check);
void read(const pb::Detection& from, api::Detection& to, Check& check);
void read(const pb::CoverageSummary& from, api::CoverageSummary& to, Check& check);
void read(const pb::GridLists& from, api::GridLists& to, Check& check);
void read(const pb::GridReport& from, api::GridReport& to, Check& check);

void write(const api::LinkSteps& from, google::protobuf::RepeatedPtrField<pb::LinkStep>& to);
void write(const api::LinkCountdown& from, pb::LinkCountdown* to);
void read(const google::protobuf::RepeatedPtrField<pb::LinkStep>& from, api::LinkSteps& to, Check& check);
void read(const pb::LinkCountdown& from, api::LinkCountdown& to, Check& check);

/// Writes at most kMaxDecisionCandidates candidates.
void write(const ExploreDecision& from, pb::ExploreDecision* to);
void write(const api::MissionRequest& from, pb::MissionRequest* to);
void write(const api::MissionStatus& from, pb::MissionStatus* to);
void read(const pb::ExploreDecision& from, ExploreDecision& to, Check& check);
void read(const pb::MissionRequest& from, api::MissionRequest& to, Check& check);
void read(const pb::MissionStatus& from, api::MissionStatus& to, Check& check);

void write(const PoseEstimate& from, pb::PoseEstimate* to);
void write(const api::RobotInfo& from, pb::RobotInfo* to);
void write(const api::ComponentInfo& from, pb::ComponentInfo* to);
void write(const api::ComponentSetting& from, pb::ComponentSetting* to);
void write(const api::LeaseState& from, pb::LeaseState* to);
void write(const api::RobotStatus& from, pb::RobotStatus* to);
void write(const api::Event& from, pb::Event* to);
void write(const api::DriveCommand& from, pb::DriveCommand* to);
void read(const pb::PoseEstimate& from, PoseEstimate& to, Check& check);
void read(const pb::RobotInfo& from, api::RobotInfo& to, Check& check);
void read(const pb::ComponentInfo& from, api::ComponentInfo& to, Check& check);
void read(const pb::ComponentSetting& from, api::ComponentSetting& to, Check& check);
void read(const pb::LeaseState& from, api::LeaseState& to, Check& check);
void read(const pb::RobotStatus& from, api::RobotStatus& to, Check& check);
void read(const pb::Event& from, api::Event& to, Check& check);
void read(const pb::DriveCommand& from, api::DriveCommand& to, Check& check);

void write(const api::FileOffer& from, pb::BeginUploadRequest* to);
void write(const api::UploadPiece& from, pb::UploadPieceRequest* to);
void write(const api::UploadEnd& from, pb::FinishUploadRequest* to);
void write(const api::UploadedFile& from, pb::FinishUploadResponse* to);
void write(const api::FileRead& from, pb::ReadFileRequest* to);
void write(const api::FilePiece& from, pb::ReadFileResponse* to);
void read(const pb::BeginUploadRequest& from, api::FileOffer& to, Check& check);
void read(const pb::UploadPieceRequest& from, api::UploadPiece& to, Check& check);
void read(const pb::FinishUploadRequest& from, api::UploadEnd& to, Check& check);
void read(const pb::FinishUploadResponse& from, api::UploadedFile& to, Check& check);
void read(const pb::ReadFileRequest& from, api::FileRead& to, Check& check);
void read(const pb::ReadFileResponse& from, api::FilePiece& to, Check& check);
void write(const api::Finding& from, pb::Finding* to);
/// Writes the outcome of a command into its record.
void set_outcome(api::AuditRecord& record, const Status& outcome);
void write(const api::AuditRecord& from, pb::AuditRecord* to);
void read(const pb::Finding& from, api::Finding& to, Check& check);
void read(const pb::AuditRecord& from, api::AuditRecord& to, Check& check);

/// Writes an update except its subscription id and drop count, which differ between receivers.
void write(const api::Update& from, pb::StreamUpdate* to);
/// Reads an update; its `subscription_id` is not a part of the value.
void read(const pb::StreamUpdate& from, api::Update& to, Check& check);

void write(const api::TopicRequest& from, pb::TopicRequest* to);
void read(const pb::TopicRequest& from, api::TopicRequest& to, Check& check);

/// The value of a message, or the first error in it.
template <class T, class M>
[[nodiscard]] Result<T> from_message(const M& message) {
  Check check;
  T value{};
  read(message, value, check);
  if (!check.ok()) {
    return tl::unexpected<Error>(check.status().error());
  }
  return value;
}

template <class M, class T>
[[nodiscard]] M to_message(const T& value) {
  M message;
  write(value, &message);
  return message;
}

/// Reads a sub-message that must be present.
template <class M, class T>
void read_required(bool present, const M& from, T& to, std::string_view field, Check& check) {
  if (check.require(field, present)) {
    const auto scope = check.in(field);
    read(from, to, check);
  }
}

}  // namespace seeker::wire
