#include "common/rpc/urgent_calls.hpp"

#include <utility>

namespace seeker::rpc {
namespace {

/// Whether the robot has said nothing: another copy may still reach it.
bool went_astray(const Result<std::vector<seeker::v1::Response>>& answer) {
  return !answer && (answer.error().code == Errc::kLinkLost || answer.error().code == Errc::kTimeout);
}

}  // namespace

void UrgentCalls::call(const seeker::v1::Request& request, Duration timeout, const wire::ClientSession::Answer& answer,
                       const std::vector<RobotLink*>& links) {
  std::erase_if(calls_, [](const auto& call) { return call.expired(); });
  const auto call = std::make_shared<Call>(Call{request, timeout, answer});
  calls_.push_back(call);
  // Counted before: a link that is not open answers at once.
  call->copies = static_cast<int>(links.size());
  for (RobotLink* link : links) {
    send_copy(call, *link);
  }
}

void UrgentCalls::opened(RobotLink& link) {
  for (const auto& waiting : std::exchange(calls_, {})) {
    if (const auto call = waiting.lock(); call && !call->answered) {
      calls_.push_back(call);
      ++call->copies;
      send_copy(call, link);
    }
  }
}

void UrgentCalls::send_copy(const std::shared_ptr<Call>& call, RobotLink& link) {
  link.call(call->request, call->timeout, [call](Result<std::vector<seeker::v1::Response>> answer) {
    const bool last = --call->copies == 0;
    if (!call->answered && (last || !went_astray(answer))) {
      call->answered = true;
      call->answer(std::move(answer));
    }
  });
}

}  // namespace seeker::rpc
