#include "common/wire/convert.hpp"

namespace seeker::wire {
namespace {

void write_step(const api::LinkStep& from, pb::LinkStep* to) {
  to->set_after_ns(from.after.count());
  to->set_action(static_cast<pb::LinkAction>(wire_enum(from.action)));
}

void read_step(const pb::LinkStep& from, api::LinkStep& to, Check& check) {
  to.after = Duration(from.after_ns());
  check.enumerator("action", from.action(), api::LinkAction::kContinue, to.action);
}

}  // namespace

void write(const api::LinkSteps& from, google::protobuf::RepeatedPtrField<pb::LinkStep>& to) {
  for (const api::LinkStep& step : from) {
    write_step(step, to.Add());
  }
}

void read(const google::protobuf::RepeatedPtrField<pb::LinkStep>& from, api::LinkSteps& to, Check& check) {
  if (!check.count("link_steps", static_cast<std::size_t>(from.size()), api::kMaxLinkSteps)) {
    return;
  }
  to.resize(static_cast<std::size_t>(from.size()));
  for (std::size_t k = 0; k < to.size(); ++k) {
    const auto scope = check.in("link_steps", k);
    read_step(from[static_cast<int>(k)], to[k], check);
  }
}

void write(const api::LinkCountdown& from, pb::LinkCountdown* to) {
  to->set_silent_ns(from.silent.count());
  if (from.next) {
    write_step(*from.next, to->mutable_next());
  }
  to->set_left_ns(from.left.count());
}

void read(const pb::LinkCountdown& from, api::LinkCountdown& to, Check& check) {
  to.silent = Duration(from.silent_ns());
  if (from.has_next()) {
    const auto scope = check.in("next");
    read_step(from.next(), to.next.emplace(), check);
  }
  to.left = Duration(from.left_ns());
}

}  // namespace seeker::wire
