#include "common/rpc/urgent_calls.hpp"

#include <utility>

#include "common/wire/outcome.hpp"

namespace seeker::rpc {
namespace {

/// Whether the robot has said nothing: another request may still reach it.
bool went_astray(const Result<std::vector<seeker::v1::Response>>& answer) {
  return !answer && (answer.error().code == Errc::kLinkLost || answer.error().code == Errc::kTimeout);
}

bool succeeded(const Result<std::vector<seeker::v1::Response>>& answer) {
  return answer && wire::outcome(answer->front());
}

}  // namespace

void UrgentCalls::call(Call call, const Answer& answer, RobotLink& main,
                       const std::vector<std::shared_ptr<RobotLink>>& others) {
  std::erase_if(calls_, [](const auto& one) { return one.expired(); });
  const wire::WallTime deadline = net::wall_now() + call.timeout;
  const auto waiting = std::make_shared<Waiting>(Waiting{std::move(call), deadline, answer});
  calls_.push_back(waiting);
  ++waiting->open;  // until all are sent: a link that is not open answers at once
  for (const auto& link : others) {
    if (link->open()) {
      send(waiting, *link, false);
    }
  }
  --waiting->open;
  send(waiting, main, true);
}

void UrgentCalls::opened(RobotLink& link) {
  for (const auto& one : std::exchange(calls_, {})) {
    if (const auto waiting = one.lock(); waiting && !waiting->answered) {
      calls_.push_back(waiting);
      send(waiting, link, false);
    }
  }
}

void UrgentCalls::send(const std::shared_ptr<Waiting>& waiting, RobotLink& link, bool main) {
  const Duration left = waiting->deadline - net::wall_now();
  if (!main && left <= Duration::zero()) {
    return;
  }
  ++waiting->open;
  const Call& call = waiting->call;
  link.call(main ? call.request : call.copy, left, [waiting, main](Result<std::vector<seeker::v1::Response>> answer) {
    const bool last = --waiting->open == 0;
    const bool settles = succeeded(answer) || (main && !went_astray(answer)) || last;
    if (settles && !waiting->answered) {
      waiting->answered = true;
      waiting->answer(std::move(answer));
    }
  });
}

}  // namespace seeker::rpc
