#include "common/wire/convert.hpp"
#include "common/wire/hash_field.hpp"

namespace seeker::wire {
namespace {

pb::FileKind kind_of(api::FileKind kind) { return static_cast<pb::FileKind>(wire_enum(kind)); }

std::vector<std::uint8_t> read_data(const std::string& from, Check& check) {
  if (from.size() > api::kMaxFilePiece_bytes) {
    check.refuse("data", Errc::kTooLarge, "has more than 1 MiB; send smaller pieces");
    return {};
  }
  return {from.begin(), from.end()};
}

}  // namespace

void write(const api::FileOffer& from, pb::BeginUploadRequest* to) {
  to->set_kind(kind_of(from.kind));
  to->set_sha256(bytes_of(from.hash));
  to->set_size_bytes(from.size_bytes);
}

void read(const pb::BeginUploadRequest& from, api::FileOffer& to, Check& check) {
  check.enumerator("kind", from.kind(), api::FileKind::kPicture, to.kind);
  read_hash("sha256", from.sha256(), to.hash, check);
  to.size_bytes = from.size_bytes();
}

void write(const api::UploadPiece& from, pb::UploadPieceRequest* to) {
  to->set_sha256(bytes_of(from.hash));
  to->set_offset(from.offset);
  to->mutable_data()->assign(from.bytes.begin(), from.bytes.end());
}

void read(const pb::UploadPieceRequest& from, api::UploadPiece& to, Check& check) {
  read_hash("sha256", from.sha256(), to.hash, check);
  to.offset = from.offset();
  to.bytes = read_data(from.data(), check);
  if (check.ok() && to.bytes.empty()) {
    check.refuse("data", Errc::kInvalidArgument, "is empty");
  }
}

void write(const api::UploadEnd& from, pb::FinishUploadRequest* to) {
  to->set_kind(kind_of(from.kind));
  to->set_sha256(bytes_of(from.hash));
  to->set_name(clean_text(from.name, kMaxMapNameBytes));
  to->set_replace(from.replace);
  to->set_check_only(from.check_only);
}

void read(const pb::FinishUploadRequest& from, api::UploadEnd& to, Check& check) {
  check.enumerator("kind", from.kind(), api::FileKind::kPicture, to.kind);
  read_hash("sha256", from.sha256(), to.hash, check);
  to.name = check.text("name", from.name(), kMaxMapNameBytes);
  to.replace = from.replace();
  to.check_only = from.check_only();
}

void write(const api::UploadedFile& from, pb::FinishUploadResponse* to) {
  if (from.map) {
    write(*from.map, to->mutable_map());
  }
  if (from.landmarks) {
    write(*from.landmarks, to->mutable_database());
  }
}

void read(const pb::FinishUploadResponse& from, api::UploadedFile& to, Check& check) {
  if (from.has_map()) {
    const auto scope = check.in("map");
    read(from.map(), to.map.emplace(), check);
  }
  if (from.has_database()) {
    const auto scope = check.in("database");
    read(from.database(), to.landmarks.emplace(), check);
  }
}

void write(const api::FileRead& from, pb::ReadFileRequest* to) {
  to->set_kind(kind_of(from.kind));
  to->set_name(clean_text(from.name, kMaxMapNameBytes));
  to->set_offset(from.offset);
  to->set_max_bytes(from.max_bytes);
  if (from.hash) {
    to->set_sha256(bytes_of(*from.hash));
  }
}

void read(const pb::ReadFileRequest& from, api::FileRead& to, Check& check) {
  check.enumerator("kind", from.kind(), api::FileKind::kLandmarks, to.kind);
  to.name = check.text("name", from.name(), kMaxMapNameBytes);
  to.offset = from.offset();
  to.max_bytes = from.max_bytes();
  if (to.max_bytes > api::kMaxFilePiece_bytes) {
    check.refuse("max_bytes", Errc::kTooLarge, "is more than 1 MiB");
  }
  if (!from.sha256().empty()) {
    read_hash("sha256", from.sha256(), to.hash.emplace(), check);
  }
}

void write(const api::FilePiece& from, pb::ReadFileResponse* to) {
  to->set_sha256(bytes_of(from.hash));
  to->set_size_bytes(from.size_bytes);
  to->mutable_data()->assign(from.bytes.begin(), from.bytes.end());
}

void read(const pb::ReadFileResponse& from, api::FilePiece& to, Check& check) {
  read_hash("sha256", from.sha256(), to.hash, check);
  to.size_bytes = from.size_bytes();
  to.bytes = read_data(from.data(), check);
}

}  // namespace seeker::wire
