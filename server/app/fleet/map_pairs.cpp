#include "server/app/fleet/map_pairs.hpp"

#include <algorithm>
#include <utility>

#include "server/fleet/merge_memory.hpp"

namespace seeker::app {

namespace {

bool same_pictures(const fleet::NodePictures& a, const fleet::NodePictures& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const auto& one, const auto& other) { return one == other || *one == *other; });
}

}  // namespace

Status MapPairs::update(std::uint8_t slot, LineMap map, fleet::NodePictures pictures) {
  fleet::PreparedMap& prepared = prepared_[slot];
  const bool same_map = prepared.map() == map;
  if (same_map && same_pictures(prepared.pictures(), pictures)) {
    return {};
  }
  ++versions_[slot];
  prepared.set_pictures(std::move(pictures));
  return same_map ? Status() : prepared.update(std::move(map));
}

void MapPairs::forget_map(std::uint8_t slot) {
  prepared_.erase(slot);
  std::erase_if(pairs_, [slot](const auto& pair) { return pair.first.first == slot || pair.first.second == slot; });
}

void MapPairs::recall(fleet::PairAnswer pair, WallTime now) {
  const std::uint8_t a = pair.slot_a;
  const std::uint8_t b = pair.slot_b;
  if (!contains(a) || !contains(b)) {
    return;
  }
  const bool stale = !fleet::holds(pair.answer, prepared_.at(a), prepared_.at(b));
  pairs_[{a, b}] = {std::move(pair.answer), now, {version(a), version(b)}, stale};
}

void MapPairs::mark_stale() {
  for (auto& [slots, compared] : pairs_) {
    compared.stale =
        compared.stale || !fleet::holds(compared.answer, prepared_.at(slots.first), prepared_.at(slots.second));
  }
}

void MapPairs::compare(std::uint8_t a, std::uint8_t b) {
  const std::pair versions{version(a), version(b)};
  const auto before = pairs_.find({a, b});
  if (before != pairs_.end() && !before->second.stale && before->second.versions == versions) {
    return;
  }
  fleet::MergeAnswer answer = merger_.merge(prepared_.at(a), prepared_.at(b));
  if (before != pairs_.end()) {
    fleet::judge_again(answer, before->second.answer, merger_.params());
  }
  pairs_[{a, b}] = {std::move(answer), std::chrono::steady_clock::now(), versions};
}

void MapPairs::compare_aged(std::uint8_t a, std::uint8_t b, WallTime now) {
  const auto known = pairs_.find({a, b});
  if (known == pairs_.end() || known->second.stale || now - known->second.at > retry_period_) {
    compare(a, b);
  }
}

const LineMap& MapPairs::map(std::uint8_t slot) const {
  static const LineMap none;
  const auto prepared = prepared_.find(slot);
  return prepared == prepared_.end() ? none : prepared->second.map();
}

const fleet::NodePictures& MapPairs::pictures(std::uint8_t slot) const {
  static const fleet::NodePictures none;
  const auto prepared = prepared_.find(slot);
  return prepared == prepared_.end() ? none : prepared->second.pictures();
}

std::uint64_t MapPairs::version(std::uint8_t slot) const {
  const auto version = versions_.find(slot);
  return version == versions_.end() ? 0 : version->second;
}

std::vector<fleet::PairAnswer> MapPairs::fresh_answers() const {
  std::vector<fleet::PairAnswer> answers;
  answers.reserve(pairs_.size());
  for (const auto& [slots, compared] : pairs_) {
    if (!compared.stale) {
      answers.push_back({slots.first, slots.second, compared.answer});
    }
  }
  return answers;
}

std::vector<fleet::PairAnswer> MapPairs::all_answers() const {
  std::vector<fleet::PairAnswer> answers;
  answers.reserve(pairs_.size());
  for (const auto& [slots, compared] : pairs_) {
    answers.push_back({slots.first, slots.second, compared.answer});
  }
  return answers;
}

}  // namespace seeker::app
