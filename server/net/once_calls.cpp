#include "server/net/once_calls.hpp"

#include <algorithm>
#include <mutex>
#include <optional>
#include <vector>

namespace seeker::server_net {
namespace {

/// More than are on their way at any time: a client has a handful of connections and stops once.
constexpr std::size_t kKept = 256;
/// A client has a handful of connections.
constexpr std::size_t kMostWaiting = 64;

/// The call, its number (0: it has no copies), and whether it is a copy.
struct Mark {
  std::pair<int, std::uint64_t> key;
  bool copy = false;
};

Mark mark_of(const seeker::v1::Request& request) {
  using R = seeker::v1::Request;
  switch (request.call_case()) {
    case R::kStop: return {{R::kStop, request.stop().once()}, request.stop().copy()};
    case R::kSetEstop:
      return {{R::kSetEstop, request.set_estop().engaged() ? request.set_estop().once() : 0},
              request.set_estop().copy()};
    default: return {{request.call_case(), 0}, false};
  }
}

}  // namespace

/// What a call came to, and who waits for that.
class OnceCalls::Outcome {
 public:
  void tell(const api::Reply<void>& reply) {
    std::unique_lock lock(mutex_);
    if (!outcome_ && waiting_.size() < kMostWaiting) {
      waiting_.push_back(reply);
      return;
    }
    const Status outcome = outcome_.value_or(fail(Errc::kBusy, "too many copies wait for the same answer"));
    lock.unlock();
    reply(outcome);
  }
  void set(const Status& outcome) {
    std::vector<api::Reply<void>> waiting;
    {
      const std::lock_guard lock(mutex_);
      outcome_ = outcome;
      waiting.swap(waiting_);
    }
    for (const auto& reply : waiting) {
      reply(outcome);
    }
  }

 private:
  std::mutex mutex_;
  std::optional<Status> outcome_;
  std::vector<api::Reply<void>> waiting_;
};

const OnceCalls::Entry* OnceCalls::find(const Key& key) const {
  const auto found = std::find_if(newest_.begin(), newest_.end(), [&](const Entry& one) { return one.key == key; });
  return key.second == 0 || found == newest_.end() ? nullptr : &*found;
}

bool OnceCalls::known(const seeker::v1::Request& request) const {
  const auto [key, copy] = mark_of(request);
  const Entry* entry = find(key);
  return entry != nullptr && (copy || !entry->requested);
}

void OnceCalls::carry_out(const seeker::v1::Request& request, const api::Reply<void>& reply, const Work& work) {
  const auto [key, copy] = mark_of(request);
  const Entry* entry = find(key);
  if (entry != nullptr && copy) {
    entry->outcome->tell(reply);
    return;
  }
  if (key.second == 0) {
    work(reply);
    return;
  }
  const auto outcome = std::make_shared<Outcome>();
  outcome->tell(reply);
  newest_.push_front({key, !copy, outcome});
  if (newest_.size() > kKept) {
    newest_.pop_back();
  }
  work([outcome](const Status& done) { outcome->set(done); });
}

}  // namespace seeker::server_net
