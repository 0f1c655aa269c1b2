// Driving by hand, the right to do so, and stopping.

#include <CLI/CLI.hpp>

#include "client/cli/parser_parts.hpp"
#include "common/config/number_text.hpp"

namespace seeker::cli {
namespace {

/// One action on the lease; its options write to the struct of the whole verb.
CLI::App* add_lease_action(CLI::App& lease, LeaseVerb& verb, LeaseVerbAction action, const std::string& name,
                           const std::string& description) {
  return add_subcommand(lease, name, description, "seeker --as anna lease " + name,
                        [&verb, action] { verb.action = action; });
}

void add_lease(Parse& parse) {
  auto [lease, l] = add_verb<LeaseVerb>(parse, parse.app, "lease",
                                        "Who holds the lease, the right to drive by hand; hold it, ask for it, answer",
                                        "seeker lease\n  seeker --as anna lease acquire");
  lease->require_subcommand(0, 1);
  using Action = LeaseVerbAction;
  CLI::App* acquire = add_lease_action(*lease, *l, Action::kAcquire, "acquire",
                                       "Hold the lease until Ctrl-C, so that nobody else has the robot move");
  CLI::App* request = add_lease_action(*lease, *l, Action::kRequest, "request",
                                       "Ask the owner for the lease, and hold it until Ctrl-C when it is granted");
  CLI::App* take_over = add_lease_action(*lease, *l, Action::kTakeOver, "take-over",
                                         "Take the lease from its owner, and hold it until Ctrl-C");
  take_over->add_flag("--yes", l->yes, "Really: its owner loses it at once");
  for (CLI::App* holds : {acquire, request, take_over}) {
    holds->add_option("--for", l->for_s, "Seconds to hold it")->check(config::number_above_zero, "above 0");
  }
  add_lease_action(*lease, *l, Action::kGrant, "grant", "As its owner: give the lease to the client that asks for it");
  add_lease_action(*lease, *l, Action::kDeny, "deny", "As its owner: keep the lease");
  add_lease_action(*lease, *l, Action::kRelease, "release", "As its owner: give the lease back");
}

}  // namespace

void add_motion(Parse& parse) {
  auto [drive, d] = add_verb<DriveVerb>(
      parse, parse.app, "drive", "Drive by hand: a velocity for some seconds, or the keyboard while a key is held",
      "seeker drive 0.2 0 --for 3\n  seeker drive          (keyboard: arrows or w a s d, space stops, q ends)");
  CLI::Option* v = drive->add_option("v", d->v_m_s, "Forward velocity, m/s")->check(config::finite_number);
  CLI::Option* omega = drive->add_option("omega", d->omega_rad_s, "Turn rate, rad/s, positive to the left")
                           ->check(config::finite_number);
  v->needs(omega);
  drive->add_option("--for", d->for_s, "Seconds to drive")
      ->check(CLI::Range(0.1, 600.0))
      ->check(config::finite_number)
      ->capture_default_str();
  drive->add_flag("--take-over", d->take_over, "Take the lease from its present owner");
  add_lease(parse);
  add_verb<StopVerb>(parse, parse.app, "stop", "End mission and motion", "seeker stop");
  auto [estop, e] = add_verb<EstopVerb>(parse, parse.app, "estop", "Emergency stop: latches until it is released",
                                        "seeker estop\n  seeker estop --release");
  estop->add_flag("--release", e->release, "Release the latch; the robot does not move by itself");
  add_verb<PauseVerb>(parse, parse.app, "pause", "Pause the mission", "seeker pause");
  add_verb<ResumeVerb>(parse, parse.app, "resume", "Go on with the paused mission", "seeker resume");
}

}  // namespace seeker::cli
