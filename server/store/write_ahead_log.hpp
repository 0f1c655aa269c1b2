/// \file
/// The log beside a database, as SQLite writes it. SQLite reads it up to the first byte that is not as it was written,
/// and forgets what comes after without a word.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace seeker::store {

/// Number of transactions in the log that SQLite would forget. One may have been cut off while it was written; more
/// than one means that the log was damaged since, because each is on the disk before the next one begins. A log that
/// was cut between two transactions cannot be distinguished from a whole one. 0 for what is no log.
[[nodiscard]] std::size_t forgotten_transactions(std::span<const std::uint8_t> log);

}  // namespace seeker::store
