#include "server/app/fleet/announced_map.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "common/digest/sha256.hpp"

namespace seeker::app {
namespace {

/// Size of the piece with this hash, of a local map or a picture; no value where the manifest does not name it.
std::optional<std::uint64_t> bytes_of(const api::FleetManifest& manifest, const api::PieceHash& hash) {
  const auto has_hash = [&](const auto& one) { return one.hash == hash; };
  const auto node = std::find_if(manifest.nodes.begin(), manifest.nodes.end(), has_hash);
  if (node != manifest.nodes.end()) {
    return node->piece_bytes;
  }
  const auto picture = std::find_if(manifest.pictures.begin(), manifest.pictures.end(), has_hash);
  return picture == manifest.pictures.end() ? std::nullopt : std::optional(picture->piece_bytes);
}

}  // namespace

AnnouncedMap::AnnouncedMap(api::FleetManifest manifest, Pieces pieces)
    : manifest_(std::move(manifest)), pieces_(std::move(pieces)) {}

void AnnouncedMap::announce(const api::FleetManifest& manifest) {
  manifest_ = manifest;
  const auto drop_unnamed = [&](auto& pieces) {
    std::erase_if(pieces, [&](const auto& piece) { return !bytes_of(manifest_, piece.first); });
  };
  drop_unnamed(pieces_);
  drop_unnamed(partial_);
}

std::vector<api::FleetMissing> AnnouncedMap::missing() const {
  std::vector<api::FleetMissing> missing;
  const auto add_missing = [&](const auto& named) {
    for (const auto& one : named) {
      if (!pieces_.contains(one.hash)) {
        const auto begun = partial_.find(one.hash);
        missing.push_back({one.hash, begun == partial_.end() ? 0 : begun->second.size()});
      }
    }
  };
  add_missing(manifest_.nodes);
  add_missing(manifest_.pictures);
  return missing;
}

Result<AnnouncedMap::Receipt> AnnouncedMap::receive(const api::FleetChunk& chunk) {
  const std::optional<std::uint64_t> piece_bytes = bytes_of(manifest_, chunk.hash);
  if (!piece_bytes) {
    return fail(Errc::kNotFound, kNotAnnounced);
  }
  if (pieces_.contains(chunk.hash)) {
    return Receipt{*piece_bytes, nullptr};
  }
  std::vector<std::uint8_t>& begun = partial_[chunk.hash];
  if (chunk.offset != begun.size()) {
    return Receipt{begun.size(), nullptr};  // sent twice, or a gap: the sender goes on from here
  }
  if (chunk.data.empty() || begun.size() + chunk.data.size() > *piece_bytes) {
    partial_.erase(chunk.hash);
    return fail(Errc::kTooLarge, "the piece is longer than it was announced, or nothing was sent");
  }
  begun.insert(begun.end(), chunk.data.begin(), chunk.data.end());
  if (begun.size() < *piece_bytes) {
    return Receipt{begun.size(), nullptr};
  }
  const auto bytes = std::make_shared<const std::vector<std::uint8_t>>(std::move(begun));
  partial_.erase(chunk.hash);
  if (digest::sha256_of(*bytes) != chunk.hash) {
    return fail(Errc::kCorrupt, "the piece does not have the hash that was announced; it was thrown away");
  }
  pieces_[chunk.hash] = bytes;
  return Receipt{bytes->size(), bytes};
}

}  // namespace seeker::app
