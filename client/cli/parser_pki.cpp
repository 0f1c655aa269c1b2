// Certificates of a site.

#include <CLI/CLI.hpp>

#include "client/cli/parser_parts.hpp"
#include "client/values/names.hpp"
#include "common/pki/role.hpp"

namespace seeker::cli {
namespace {

template <class Verb>
void add_site(CLI::App& sub, Verb& verb) {
  sub.add_option("--site", verb.site, "Folder of the site (default: ~/.config/seeker/site)");
}

void add_issue(Parse& parse, CLI::App& pki) {
  auto [issue, o] =
      add_verb<PkiIssueVerb>(parse, pki, "issue", "Make a folder with key and certificate for a person or a robot",
                             "seeker pki issue anna --role operator --out ~/.config/seeker/tls\n"
                             "  seeker pki issue r1 --role robot --host 10.0.0.5 --host r1.local\n"
                             "With --overwrite the same renews it; a robot notices new files by itself.");
  issue->add_option("name", o->name, "Name of the person, or the robot's id")->required();
  issue->add_option("--role", o->role, "What its owner may do; robot: for seekerd and seeker-emulator")
      ->required()
      ->check(CLI::IsMember(names_of(pki::kRoles)));
  repeatable(issue->add_option("--host", o->hosts, "Name or IP address at which a robot is reached; repeatable"));
  issue->add_option("--days", o->days, "Days until it expires")->check(CLI::Range(1, 36500))->capture_default_str();
  issue->add_option("--out", o->out, "Folder to write (default: bundles/NAME of the site)");
  issue->add_flag("--overwrite", o->overwrite, "Replace the key and certificate that are there");
  add_site(*issue, *o);
}

}  // namespace

void add_pki(Parse& parse) {
  CLI::App* pki = add_group(parse.app, "pki", "Certificates of a site: who may connect to its robots, and as what",
                            "seeker pki init\n  seeker pki issue anna --role operator");
  auto [init, i] = add_verb<PkiInitVerb>(parse, *pki, "init", "Make the certificate authority (CA) of a site",
                                         "seeker pki init\n  seeker pki init /media/stick/site --name \"Site north\"");
  init->add_option("folder", i->folder, "Folder of the site (default: ~/.config/seeker/site)");
  init->add_option("--name", i->name, "Name of the CA")->capture_default_str();
  init->add_option("--days", i->days, "Days until it expires")->check(CLI::Range(1, 36500))->capture_default_str();
  init->add_flag("--overwrite", i->overwrite, "Replace a CA: all its certificates become void");
  add_issue(parse, *pki);
  auto [revoke, r] =
      add_verb<PkiRevokeVerb>(parse, *pki, "revoke", "Declare certificates void before they expire",
                              "seeker pki revoke anna\n"
                              "Copy the site's crl.pem to each robot then; sessions end within a second.");
  revoke->add_option("which", r->which, "Name (all its certificates) or serial number")->required();
  add_site(*revoke, *r);
  auto [show, s] =
      add_verb<PkiShowVerb>(parse, *pki, "show", "Print certificates: name, role, validity, serial, revoked",
                            "seeker pki show\n  seeker pki show ~/.config/seeker/tls --json");
  show->add_option("what", s->what, "A certificate, a bundle or a site (default: ~/.config/seeker/site)");
}

}  // namespace seeker::cli
