/// \file
/// The CA of a site: a folder with its key, its certificates and its list of revocations.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/result.hpp"
#include "common/pki/certificate_maker.hpp"
#include "common/pki/revocation_list.hpp"

namespace seeker::pki {

struct CaWish {
  std::string name = "Seeker site";
  int days = 3650;         ///< it is valid for
  bool overwrite = false;  ///< an existing CA is replaced, and all its certificates are void
};

struct BundleWish {
  std::string name;  ///< of the person, or the robot's id
  Role role = Role::kObserver;
  std::vector<std::string> hosts;
  int days = 365;                ///< it is valid for, at most as long as the CA
  std::filesystem::path folder;  ///< of the bundle; empty: bundles/NAME of the site
  bool overwrite = false;        ///< an existing bundle is replaced (renewal)
};

/// A certificate that the CA has issued.
struct Issued {
  CertificateFacts facts;
  bool revoked = false;
};

/// Private keys are readable by their owner only, and so are the folders. One program at a time changes a site.
class SiteAuthority {
 public:
  /// Makes a CA in `folder`. kRefused: there is one already.
  [[nodiscard]] static Result<SiteAuthority> init(const std::filesystem::path& folder, const CaWish& wish,
                                                  CalendarTime now);
  /// Opens the CA of a folder. kNotFound, kIo, kCorrupt.
  [[nodiscard]] static Result<SiteAuthority> open(const std::filesystem::path& folder);

  /// Makes a bundle, a folder with ca.pem, cert.pem, key.pem and crl.pem. kInvalidArgument, kRefused (there is one
  /// already), kBusy, kIo.
  [[nodiscard]] Result<Issued> issue(const BundleWish& wish, CalendarTime now);
  /// Revokes the certificate of that serial, or all of that name. The answer: those revoked now. kNotFound, kBusy, kIo.
  [[nodiscard]] Result<std::vector<Issued>> revoke(std::string_view name_or_serial, CalendarTime now);
  /// All certificates, ordered by name, then by expiry.
  [[nodiscard]] Result<std::vector<Issued>> list() const;

  [[nodiscard]] const CertificateFacts& ca() const { return ca_.facts(); }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// Where the bundle of a wish goes.
  [[nodiscard]] std::filesystem::path bundle_folder(const BundleWish& wish) const;

 private:
  SiteAuthority(std::filesystem::path folder, Certificate ca, KeyPtr key);
  [[nodiscard]] Signer signer() const { return {ca_, key_.get()}; }
  [[nodiscard]] Status write_bundle(const BundleWish& wish, const Certificate& certificate, EVP_PKEY* key) const;

  std::filesystem::path folder_;
  Certificate ca_;
  KeyPtr key_;
};

/// Where `seeker pki` keeps the site: $XDG_CONFIG_HOME/seeker/site, or ~/.config/seeker/site.
[[nodiscard]] std::filesystem::path default_site_folder();
/// Where a person's own bundle is looked for: the folder `tls` beside it.
[[nodiscard]] std::filesystem::path default_bundle_folder();

}  // namespace seeker::pki
