// Certificates of a site: making, listing and revoking them.

#include <filesystem>

#include <nlohmann/json.hpp>

#include "client/cli/show_done.hpp"
#include "client/cli/verbs.hpp"
#include "client/values/values_json.hpp"
#include "common/pki/bundle.hpp"
#include "common/pki/site_authority.hpp"

namespace seeker::cli {
namespace {

namespace fs = std::filesystem;

pki::CalendarTime now() { return std::chrono::system_clock::now(); }

fs::path site_folder(const std::string& named) { return named.empty() ? pki::default_site_folder() : fs::path(named); }

Result<pki::SiteAuthority> open_site(const std::string& named) {
  Result<pki::SiteAuthority> site = pki::SiteAuthority::open(site_folder(named));
  return site ? std::move(site) : Result<pki::SiteAuthority>(fail_as_usage(site.error()));
}

std::string_view role_name(const pki::CertificateFacts& facts) {
  return facts.is_ca ? "CA" : facts.role ? pki::to_string(*facts.role) : "no role";
}

/// Revoked, expired, not valid yet or valid.
std::string_view standing_of(const pki::Issued& one) {
  return one.revoked                    ? "revoked"
         : one.facts.not_after <= now() ? "expired"
         : one.facts.not_before > now() ? "not valid yet"
                                        : "valid";
}

Json json_of(const pki::Issued& one) {
  return {{"name", one.facts.name},
          {"role", role_name(one.facts)},
          {"state", standing_of(one)},
          {"revoked", one.revoked},
          {"not_before", pki::iso_text(one.facts.not_before)},
          {"not_after", pki::iso_text(one.facts.not_after)},
          {"serial", one.facts.serial},
          {"issuer", one.facts.issuer},
          {"hosts", one.facts.hosts}};
}

void print(const Context& context, const pki::Issued& one) {
  std::ostream& out = *context.out;
  out << one.facts.name << "  " << role_name(one.facts) << ", " << standing_of(one) << ", until "
      << pki::date_text(one.facts.not_after) << ", serial " << one.facts.serial;
  std::string hosts;
  for (const std::string& host : one.facts.hosts) {
    hosts += (hosts.empty() ? "" : ", ") + host;
  }
  out << (hosts.empty() ? "" : ", at " + hosts) << '\n';
}

VerbResult show(const Context& context, const std::vector<pki::Issued>& all) {
  Json certificates = Json::array();
  for (const pki::Issued& one : all) {
    if (context.json) {
      certificates.push_back(json_of(one));
    } else {
      print(context, one);
    }
  }
  if (context.json) {
    *context.out << json_line({{"certificates", certificates}}) << '\n';
  }
  return ExitCode::kOk;
}

/// The CA and all it has issued.
VerbResult show_site(const Context& context, const fs::path& folder) {
  const Result<pki::SiteAuthority> site = open_site(folder.string());
  const Result<std::vector<pki::Issued>> issued =
      site ? site->list() : Result<std::vector<pki::Issued>>(tl::unexpected<Error>(site.error()));
  if (!issued) {
    return tl::unexpected<Error>(issued.error());
  }
  std::vector<pki::Issued> all{{site->ca(), false}};
  all.insert(all.end(), issued->begin(), issued->end());
  return show(context, all);
}

/// A certificate, by the list of revocations that lies beside it.
VerbResult show_certificate(const Context& context, const fs::path& file) {
  const Result<pki::Certificate> certificate = pki::Certificate::read(file);
  if (!certificate) {
    return fail_as_usage(certificate.error());
  }
  pki::Issued one{certificate->facts(), false};
  const fs::path beside = file.parent_path() / pki::kRevocationsName;
  if (std::error_code ignored; fs::exists(beside, ignored)) {
    const Result<pki::RevocationList> revoked = pki::RevocationList::read(beside);
    if (!revoked) {
      return fail_as_usage(revoked.error());
    }
    one.revoked = revoked->has(one.facts.serial);
  }
  return show(context, {one});
}

}  // namespace

VerbResult pki_init(const Context& context, const PkiInitVerb& verb) {
  const fs::path folder = site_folder(verb.folder);
  const Result<pki::SiteAuthority> site =
      pki::SiteAuthority::init(folder, {verb.name, verb.days, verb.overwrite}, now());
  return show_done(context, site ? Status() : Status(tl::unexpected<Error>(site.error())),
                   "made the site " + folder.string() +
                       "; keep its ca.key to yourself: who has it may command all "
                       "robots of the site");
}

VerbResult pki_issue(const Context& context, const PkiIssueVerb& verb) {
  Result<pki::SiteAuthority> site = open_site(verb.site);
  if (!site) {
    return tl::unexpected<Error>(site.error());
  }
  const pki::BundleWish wish{verb.name,  pki::parse_role(verb.role).value_or(pki::Role::kObserver),
                             verb.hosts, verb.days,
                             verb.out,   verb.overwrite};
  const Result<pki::Issued> issued = site->issue(wish, now());
  if (!issued) {
    return tl::unexpected<Error>(issued.error());
  }
  say(context, "wrote " + site->bundle_folder(wish).string());
  return show(context, {*issued});
}

VerbResult pki_revoke(const Context& context, const PkiRevokeVerb& verb) {
  Result<pki::SiteAuthority> site = open_site(verb.site);
  if (!site) {
    return tl::unexpected<Error>(site.error());
  }
  const Result<std::vector<pki::Issued>> revoked = site->revoke(verb.which, now());
  if (!revoked) {
    return tl::unexpected<Error>(revoked.error());
  }
  say(context, revoked->empty() ? "it was revoked before"
                                : "copy " + (site->folder() / pki::kRevocationsName).string() + " to each robot");
  return show(context, *revoked);
}

VerbResult pki_show(const Context& context, const PkiShowVerb& verb) {
  const fs::path what = site_folder(verb.what);
  std::error_code ignored;
  if (!fs::is_directory(what, ignored)) {
    return show_certificate(context, what);
  }
  return fs::exists(what / pki::kCertificateName, ignored) ? show_certificate(context, what / pki::kCertificateName)
                                                           : show_site(context, what);
}

}  // namespace seeker::cli
