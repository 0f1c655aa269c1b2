#include "client/cli/context.hpp"

#include <thread>

namespace seeker::cli {

void say(const Context& context, std::string_view text) {
  if (!context.quiet) {
    *context.err << "seeker: " << text << '\n' << std::flush;
  }
}

bool sleep_for(const Context& context, Duration duration) {
  const auto end = std::chrono::steady_clock::now() + duration;
  while (!context.interrupted()) {
    const Duration left = end - std::chrono::steady_clock::now();
    if (left <= Duration::zero()) {
      return true;
    }
    std::this_thread::sleep_for(std::min(left, kPollPeriod));
  }
  return false;
}

std::optional<Error> broken(const Context& context) {
  if (context.interrupted()) {
    return Error{Errc::kCancelled, "interrupted"};
  }
  return context.link_error();
}

}  // namespace seeker::cli
