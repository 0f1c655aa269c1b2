#include "common/wire/backlog.hpp"

#include <algorithm>

#include "common/core/assert.hpp"

namespace seeker::wire {

void Backlog::push(std::uint64_t sequence, SharedBody body) {
  SEEKER_ASSERT(sequence > last_);
  if (last_ == 0) {
    first_ever_ = sequence;
  }
  last_ = sequence;
  bytes_ += body->size();
  items_.push_back({sequence, std::move(body)});
  // The newest item stays, however large it is.
  while (items_.size() > 1 && (items_.size() > max_items_ || bytes_ > max_bytes_)) {
    bytes_ -= items_.front().body->size();
    items_.pop_front();
  }
}

const Backlog::Item* Backlog::after(std::uint64_t sequence) const {
  const auto found = std::upper_bound(items_.begin(), items_.end(), sequence,
                                      [](std::uint64_t wanted, const Item& item) { return wanted < item.sequence; });
  return found == items_.end() ? nullptr : &*found;
}

std::uint64_t Backlog::missing_after(std::uint64_t sequence) const {
  const Item* next = after(sequence);
  const std::uint64_t upto = next != nullptr ? next->sequence - 1 : last_;
  // Items that the source numbered before the first one received never belonged to this backlog.
  const std::uint64_t from = std::max(sequence, first_ever_ == 0 ? 0 : first_ever_ - 1);
  return upto > from ? upto - from : 0;
}

}  // namespace seeker::wire
