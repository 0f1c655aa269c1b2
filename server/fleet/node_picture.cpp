#include "server/fleet/node_picture.hpp"

#include <cstring>
#include <set>

namespace seeker::fleet {
namespace {

/// FNV-1a, eight bytes at a time.
void mix(std::uint64_t& hash, const void* data, std::size_t bytes) {
  constexpr std::uint64_t kPrime = 1099511628211ULL;
  const auto* at = static_cast<const unsigned char*>(data);
  for (std::size_t k = 0; k < bytes; k += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, at + k, std::min(sizeof(word), bytes - k));
    hash = (hash ^ word) * kPrime;
    hash ^= hash >> 32U;
  }
}

}  // namespace

PictureComparisons::Key PictureComparisons::key_of(const NodePicture& picture) {
  Key hash = 14695981039346656037ULL;
  const vision::ViewFeatures& features = picture.features;
  mix(hash, features.bearings_rad.data(), features.bearings_rad.size() * sizeof(float));
  mix(hash, features.descriptors.data(), features.descriptors.size() * sizeof(vision::Descriptor));
  return hash;
}

std::optional<vision::ViewMatch> PictureComparisons::match(const NodePicture& own, const NodePicture& other,
                                                           const vision::ViewMatchParams& params) {
  const std::pair key{key_of(own), key_of(other)};
  const auto known = known_.find(key);
  if (known != known_.end()) {
    return known->second;
  }
  return known_[key] = vision::match_views(own.features, other.features, params);
}

void PictureComparisons::keep_only(const NodePictures& own) {
  std::set<Key> keys;
  for (const auto& picture : own) {
    keys.insert(key_of(*picture));
  }
  std::erase_if(known_, [&](const auto& entry) { return !keys.contains(entry.first.first); });
}

}  // namespace seeker::fleet
