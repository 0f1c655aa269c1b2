#include "common/pki/site_authority.hpp"

#include <algorithm>
#include <cstdlib>
#include <tuple>
#include <utility>

#include "common/files/files.hpp"
#include "common/pki/bundle.hpp"
#include "common/pki/private_key.hpp"
#include "common/pki/site_lock.hpp"

namespace seeker::pki {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCaKeyName = "ca.key";
constexpr const char* kIssuedFolder = "issued";
constexpr const char* kBundleFolder = "bundles";
/// Clocks of robots are wrong by so much and more; what is issued now is valid for them now.
constexpr std::chrono::hours kClockError{24};
constexpr int kMaxDays = 36500;

std::chrono::hours days(int count) { return std::chrono::hours(24) * count; }

Status check_days(int count) {
  return count >= 1 && count <= kMaxDays
             ? Status()
             : fail(Errc::kInvalidArgument, "--days must be from 1 to " + std::to_string(kMaxDays));
}

/// A folder that its owner alone may look into. One that is there already stays as it is: who may look into it is its
/// owner's business.
Status make_private_folder(const fs::path& folder) {
  std::error_code error;
  if (fs::create_directories(folder, error)) {
    fs::permissions(folder, fs::perms::owner_all, error);
  }
  return error ? fail(Errc::kIo, "cannot make the folder " + folder.string() + ": " + error.message()) : Status();
}

Status write_text(const fs::path& file, const Result<std::string>& text,
                  files::ReadableBy readers = files::ReadableBy::kAll) {
  return text ? files::write_file(file, *text, readers) : Status(tl::unexpected<Error>(text.error()));
}

/// Carries steps out until one fails.
template <class... Steps>
Status in_turn(Steps... steps) {
  Status done;
  static_cast<void>(((done = steps(), done.has_value()) && ...));
  return done;
}

fs::path configuration_folder() {
  if (const char* folder = std::getenv("XDG_CONFIG_HOME"); folder != nullptr && *folder != '\0') {
    return fs::path(folder) / "seeker";
  }
  const char* home = std::getenv("HOME");
  return fs::path(home != nullptr ? home : ".") / ".config/seeker";
}

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

}  // namespace

SiteAuthority::SiteAuthority(fs::path folder, Certificate ca, KeyPtr key)
    : folder_(std::move(folder)), ca_(std::move(ca)), key_(std::move(key)) {}

Result<SiteAuthority> SiteAuthority::init(const fs::path& folder, const CaWish& wish, CalendarTime now) {
  if (is_there(folder / kCaKeyName) && !wish.overwrite) {
    return fail(Errc::kRefused, folder.string() +
                                    " has a CA already; another one would make all its certificates "
                                    "void (--overwrite does that)");
  }
  const Status possible =
      in_turn([&] { return check_days(wish.days); },
              [&] {
                const bool good = !wish.name.empty() && wish.name.size() <= 64;
                return good ? Status() : fail(Errc::kInvalidArgument, "the CA's name must have 1 to 64 bytes");
              },
              [&] { return make_private_folder(folder); });
  Result<KeyPtr> key = possible ? make_key() : Result<KeyPtr>(tl::unexpected<Error>(possible.error()));
  if (!key) {
    return tl::unexpected<Error>(key.error());
  }
  Result<Certificate> ca = make_ca(wish.name, now - kClockError, now + days(wish.days), key->get());
  if (!ca) {
    return tl::unexpected<Error>(ca.error());
  }
  SiteAuthority site(folder, std::move(*ca), std::move(*key));
  std::error_code ignored;
  fs::remove_all(folder / kIssuedFolder, ignored);  // of a CA that is replaced
  const Status written =
      in_turn([&] { return make_private_folder(folder / kIssuedFolder); },
              [&] { return write_text(folder / kCaKeyName, pem_of(site.key_.get()), files::ReadableBy::kOwner); },
              [&] { return write_text(folder / kRevocationsName, make_revocations(nullptr, "", now, site.signer())); },
              [&] { return write_text(folder / kCaName, site.ca_.pem()); });
  return written ? Result<SiteAuthority>(std::move(site))
                 : Result<SiteAuthority>(tl::unexpected<Error>(written.error()));
}

Result<SiteAuthority> SiteAuthority::open(const fs::path& folder) {
  if (!is_there(folder / kCaKeyName)) {
    return fail(Errc::kNotFound, folder.string() +
                                     " has no CA; make one with 'seeker pki init', or name another "
                                     "folder with --site");
  }
  Result<Certificate> ca = Certificate::read(folder / kCaName);
  Result<KeyPtr> key = read_key(folder / kCaKeyName);
  if (!ca || !key) {
    return tl::unexpected<Error>(ca ? key.error() : ca.error());
  }
  if (X509_check_private_key(ca->get(), key->get()) != 1) {
    return fail(Errc::kCorrupt, "the key of the CA in " + folder.string() +
                                    " is not that of its certificate; restore "
                                    "both from one backup");
  }
  return SiteAuthority(folder, std::move(*ca), std::move(*key));
}

fs::path SiteAuthority::bundle_folder(const BundleWish& wish) const {
  return wish.folder.empty() ? folder_ / kBundleFolder / wish.name : wish.folder;
}

Status SiteAuthority::write_bundle(const BundleWish& wish, const Certificate& certificate, EVP_PKEY* key) const {
  const fs::path to = bundle_folder(wish);
  return in_turn([&] { return make_private_folder(to); }, [&] { return write_text(to / kCaName, ca_.pem()); },
                 [&] { return write_text(to / kRevocationsName, read_pem(folder_ / kRevocationsName)); },
                 [&] { return write_text(to / kKeyName, pem_of(key), files::ReadableBy::kOwner); },
                 [&] { return write_text(to / kCertificateName, certificate.pem()); });
}

Result<Issued> SiteAuthority::issue(const BundleWish& wish, CalendarTime now) {
  if (!is_certificate_name(wish.name)) {
    return fail(Errc::kInvalidArgument, "'" + wish.name +
                                            "' is no name for a certificate; write 1 to 32 of "
                                            "[A-Za-z0-9._-], the first a letter or digit");
  }
  if (const Status possible = check_days(wish.days); !possible) {
    return tl::unexpected<Error>(possible.error());
  }
  const fs::path to = bundle_folder(wish);
  if (is_there(to / kKeyName) && !wish.overwrite) {
    return fail(Errc::kRefused, to.string() + " holds a bundle already; --overwrite replaces its key and certificate");
  }
  const Result<SiteLock> lock = SiteLock::take(folder_);
  Result<KeyPtr> key = lock ? make_key() : Result<KeyPtr>(tl::unexpected<Error>(lock.error()));
  if (!key) {
    return tl::unexpected<Error>(key.error());
  }
  CertificateWish say{wish.name, wish.role, wish.hosts, std::max(now - kClockError, ca_.facts().not_before),
                      std::min<CalendarTime>(now + days(wish.days), ca_.facts().not_after)};
  if (wish.role == Role::kRobot && std::find(say.hosts.begin(), say.hosts.end(), wish.name) == say.hosts.end()) {
    say.hosts.insert(say.hosts.begin(), wish.name);
  }
  const Result<Certificate> made = make_certificate(say, key->get(), signer());
  if (!made) {
    return tl::unexpected<Error>(made.error());
  }
  // Noted first: what is not noted could not be revoked by its name.
  const Status written =
      in_turn([&] { return write_text(folder_ / kIssuedFolder / (made->facts().serial + ".pem"), made->pem()); },
              [&] { return write_bundle(wish, *made, key->get()); });
  return written ? Result<Issued>(Issued{made->facts(), false})
                 : Result<Issued>(tl::unexpected<Error>(written.error()));
}

Result<std::vector<Issued>> SiteAuthority::list() const {
  const Result<RevocationList> revoked = RevocationList::read(folder_ / kRevocationsName);
  if (!revoked) {
    return tl::unexpected<Error>(revoked.error());
  }
  std::vector<Issued> all;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_ / kIssuedFolder, error)) {
    if (entry.path().extension() != ".pem") {
      continue;
    }
    const Result<Certificate> certificate = Certificate::read(entry.path());
    if (!certificate) {
      return tl::unexpected<Error>(certificate.error());
    }
    all.push_back({certificate->facts(), revoked->has(certificate->facts().serial)});
  }
  const auto key_of = [](const Issued& one) { return std::tie(one.facts.name, one.facts.not_after, one.facts.serial); };
  std::sort(all.begin(), all.end(), [&](const Issued& a, const Issued& b) { return key_of(a) < key_of(b); });
  return all;
}

Result<std::vector<Issued>> SiteAuthority::revoke(std::string_view name_or_serial, CalendarTime now) {
  const Result<SiteLock> lock = SiteLock::take(folder_);
  if (!lock) {
    return tl::unexpected<Error>(lock.error());
  }
  const Result<std::vector<Issued>> all = list();
  if (!all) {
    return all;
  }
  std::vector<Issued> meant;
  std::copy_if(all->begin(), all->end(), std::back_inserter(meant), [&](const Issued& one) {
    return one.facts.serial == name_or_serial || one.facts.name == name_or_serial;
  });
  if (meant.empty()) {
    return fail(Errc::kNotFound, "the site has issued no certificate '" + std::string(name_or_serial) +
                                     "'; 'seeker pki show' lists them");
  }
  std::erase_if(meant, [](const Issued& one) { return one.revoked; });
  for (Issued& one : meant) {
    const Result<RevocationList> former = RevocationList::read(folder_ / kRevocationsName);
    const Status written = former ? write_text(folder_ / kRevocationsName,
                                               make_revocations(former->get(), one.facts.serial, now, signer()))
                                  : Status(tl::unexpected<Error>(former.error()));
    if (!written) {
      return tl::unexpected<Error>(written.error());
    }
    one.revoked = true;
  }
  return meant;
}

fs::path default_site_folder() { return configuration_folder() / "site"; }
fs::path default_bundle_folder() { return configuration_folder() / "tls"; }

}  // namespace seeker::pki
