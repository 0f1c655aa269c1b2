/// \file
/// The newest items of a RELIABLE topic, encoded once, for clients that resume or lag behind.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

#include "common/wire/envelope.hpp"

namespace seeker::wire {

/// A ring of items: the oldest are dropped when there are too many items or bytes. Receivers hold positions, not
/// copies.
class Backlog {
 public:
  struct Item {
    std::uint64_t sequence = 0;
    SharedBody body;
  };

  Backlog(std::size_t max_items, std::size_t max_bytes) : max_items_(max_items), max_bytes_(max_bytes) {}

  /// Adds an item. Sequences rise; a step above one is a loss at the source, which is reported to receivers.
  void push(std::uint64_t sequence, SharedBody body);
  /// The first item after a sequence; null when there is none yet.
  [[nodiscard]] const Item* after(std::uint64_t sequence) const;
  /// Sequence of the newest item ever pushed; 0: none.
  [[nodiscard]] std::uint64_t last() const { return last_; }
  /// Number of items after `sequence` that are not kept any more.
  [[nodiscard]] std::uint64_t missing_after(std::uint64_t sequence) const;
  [[nodiscard]] std::size_t size() const { return items_.size(); }

 private:
  std::size_t max_items_;
  std::size_t max_bytes_;
  std::size_t bytes_ = 0;
  std::uint64_t last_ = 0;
  std::uint64_t first_ever_ = 0;
  std::deque<Item> items_;
};

}  // namespace seeker::wire
