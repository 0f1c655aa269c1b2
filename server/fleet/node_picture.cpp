#include "server/fleet/node_picture.hpp"

#include <set>
#include <string_view>

#include "common/core/hash.hpp"

namespace seeker::fleet {
namespace {

template <class T>
std::string_view bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};  // NOLINT: their bytes
}

}  // namespace

KeyedPicture keyed(const NodePicture& picture) {
  Fnv1a hash;
  hash.add(bytes_of(picture.features.bearings_rad));
  hash.add(bytes_of(picture.features.descriptors));
  return {&picture, hash.value()};
}

std::optional<vision::ViewMatch> PictureComparisons::match(const KeyedPicture& own, const KeyedPicture& other,
                                                           const vision::ViewMatchParams& params) {
  const std::pair key{own.key, other.key};
  const auto known = known_.find(key);
  if (known != known_.end()) {
    return known->second;
  }
  return known_[key] = vision::match_views(own.picture->features, other.picture->features, params);
}

void PictureComparisons::keep_only(const NodePictures& own) {
  std::set<std::uint64_t> keys;
  for (const auto& picture : own) {
    keys.insert(keyed(*picture).key);
  }
  std::erase_if(known_, [&](const auto& entry) { return !keys.contains(entry.first.first); });
}

}  // namespace seeker::fleet
