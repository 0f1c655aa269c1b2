#include "server/app/fleet/announced_map.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "common/wire/sha256.hpp"

namespace seeker::app {
namespace {

const api::FleetNode* node_of(const api::FleetManifest& manifest, const api::PieceHash& hash) {
  const auto node = std::find_if(manifest.nodes.begin(), manifest.nodes.end(),
                                 [&](const api::FleetNode& one) { return one.hash == hash; });
  return node == manifest.nodes.end() ? nullptr : &*node;
}

}  // namespace

AnnouncedMap::AnnouncedMap(api::FleetManifest manifest, Pieces pieces)
    : manifest_(std::move(manifest)), pieces_(std::move(pieces)) {}

void AnnouncedMap::announce(const api::FleetManifest& manifest) {
  manifest_ = manifest;
  const auto drop_unnamed = [&](auto& pieces) {
    std::erase_if(pieces, [&](const auto& piece) { return node_of(manifest_, piece.first) == nullptr; });
  };
  drop_unnamed(pieces_);
  drop_unnamed(partial_);
}

std::vector<api::FleetMissing> AnnouncedMap::missing() const {
  std::vector<api::FleetMissing> missing;
  for (const api::FleetNode& node : manifest_.nodes) {
    if (!pieces_.contains(node.hash)) {
      const auto begun = partial_.find(node.hash);
      missing.push_back({node.hash, begun == partial_.end() ? 0 : begun->second.size()});
    }
  }
  return missing;
}

Result<AnnouncedMap::Receipt> AnnouncedMap::receive(const api::FleetChunk& chunk) {
  const api::FleetNode* node = node_of(manifest_, chunk.hash);
  if (node == nullptr) {
    return fail(Errc::kNotFound, kNotAnnounced);
  }
  if (pieces_.contains(chunk.hash)) {
    return Receipt{node->piece_bytes, nullptr};
  }
  std::vector<std::uint8_t>& begun = partial_[chunk.hash];
  if (chunk.offset != begun.size()) {
    return Receipt{begun.size(), nullptr};  // sent twice, or a gap: the sender goes on from here
  }
  if (chunk.data.empty() || begun.size() + chunk.data.size() > node->piece_bytes) {
    partial_.erase(chunk.hash);
    return fail(Errc::kTooLarge, "the piece is longer than it was announced, or nothing was sent");
  }
  begun.insert(begun.end(), chunk.data.begin(), chunk.data.end());
  if (begun.size() < node->piece_bytes) {
    return Receipt{begun.size(), nullptr};
  }
  const auto bytes = std::make_shared<const std::vector<std::uint8_t>>(std::move(begun));
  partial_.erase(chunk.hash);
  if (wire::sha256_of(*bytes) != chunk.hash) {
    return fail(Errc::kCorrupt, "the piece does not have the hash that was announced; it was thrown away");
  }
  pieces_[chunk.hash] = bytes;
  return Receipt{bytes->size(), bytes};
}

}  // namespace seeker::app
