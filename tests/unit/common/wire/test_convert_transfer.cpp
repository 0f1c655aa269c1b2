#include <gtest/gtest.h>

#include "common/wire/convert.hpp"

namespace seeker::wire {
namespace {

api::FileHash some_hash() {
  api::FileHash hash{};
  hash.front() = 1;
  hash.back() = 255;
  return hash;
}

template <class M, class T>
void expect_same(const T& value) {
  const Result<T> back = from_message<T>(to_message<M>(value));
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(*back, value);
}

TEST(ConvertTransfer, ValuesComeBackAsTheyWere) {
  for (const api::FileKind kind : {api::FileKind::kMap, api::FileKind::kLandmarks, api::FileKind::kPicture}) {
    expect_same<pb::BeginUploadRequest>(api::FileOffer{kind, some_hash(), 1UL << 40U});
    expect_same<pb::FinishUploadRequest>(api::UploadEnd{kind, some_hash(), "office", true, true});
  }
  expect_same<pb::UploadPieceRequest>(api::UploadPiece{some_hash(), 77, {1, 2, 3}});
  expect_same<pb::ReadFileRequest>(api::FileRead{api::FileKind::kLandmarks, "lab", 5, 6, some_hash()});
  expect_same<pb::ReadFileRequest>(api::FileRead{api::FileKind::kMap, "lab", 5, 0, std::nullopt});
  expect_same<pb::ReadFileResponse>(api::FilePiece{some_hash(), 9, {4, 5}});
  expect_same<pb::FinishUploadResponse>(api::UploadedFile{});
  api::UploadedFile both;
  both.map.emplace().name = "office";
  both.landmarks.emplace().name = "lab";
  expect_same<pb::FinishUploadResponse>(both);
}

TEST(ConvertTransfer, WhatIsOutsideItsLimitsIsRefusedByName) {
  auto offer = to_message<pb::BeginUploadRequest>(api::FileOffer{api::FileKind::kMap, some_hash(), 1});
  offer.set_kind(static_cast<pb::FileKind>(9));
  EXPECT_EQ(from_message<api::FileOffer>(offer).error().code, Errc::kInvalidArgument);
  offer.set_kind(pb::FILE_KIND_MAP);
  offer.set_sha256("short");
  EXPECT_EQ(from_message<api::FileOffer>(offer).error().message, "field 'sha256' does not have 32 bytes");

  auto piece = to_message<pb::UploadPieceRequest>(api::UploadPiece{some_hash(), 0, {}});
  EXPECT_EQ(from_message<api::UploadPiece>(piece).error().code, Errc::kInvalidArgument) << "it is empty";
  piece.mutable_data()->assign(api::kMaxFilePiece_bytes + 1, 'x');
  EXPECT_EQ(from_message<api::UploadPiece>(piece).error().code, Errc::kTooLarge);

  auto wish = to_message<pb::ReadFileRequest>(api::FileRead{api::FileKind::kMap, "a", 0, 1, std::nullopt});
  wish.set_kind(pb::FILE_KIND_PICTURE);
  EXPECT_EQ(from_message<api::FileRead>(wish).error().code, Errc::kInvalidArgument) << "pictures are not given out";
  wish.set_kind(pb::FILE_KIND_MAP);
  wish.set_max_bytes(api::kMaxFilePiece_bytes + 1);
  EXPECT_EQ(from_message<api::FileRead>(wish).error().code, Errc::kTooLarge);
}

TEST(ConvertTransfer, TargetNamesItsPictureByHash) {
  api::MissionRequest request;
  request.id = "m";
  api::TargetSpec target;
  target.name = "mug";
  target.picture_hash = some_hash();
  request.task = api::RecogniseMission{{target}, 1};
  expect_same<pb::MissionRequest>(request);
  EXPECT_TRUE(api::validate(request));
  auto& both = std::get<api::RecogniseMission>(request.task).targets.front();
  both.picture = Image(16, 16, 1);
  EXPECT_EQ(api::validate(request).error().code, Errc::kInvalidArgument) << "a picture, and the hash of one";
}

}  // namespace
}  // namespace seeker::wire
