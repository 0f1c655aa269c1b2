/// \file
/// A site with its own CA, for tests of TLS.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/pki/site_authority.hpp"
#include "tests/support/process.hpp"

namespace seeker::testing {

class TestSite {
 public:
  TestSite()
      : folder_(fresh_folder("site-" + std::to_string(++made_))),
        site_(pki::SiteAuthority::init(folder_, {}, today()).value()) {}

  [[nodiscard]] static pki::CalendarTime today() { return std::chrono::system_clock::now(); }

  /// A bundle that is valid for a year from `from`; one that is there is renewed.
  pki::BundleFiles issue(const std::string& name, pki::Role role, const std::vector<std::string>& hosts = {},
                         pki::CalendarTime from = today(), int days = 365) {
    const pki::BundleWish wish{name, role, hosts, days, {}, true};
    const Result<pki::Issued> issued = site_.issue(wish, from);
    EXPECT_TRUE(issued) << issued.error().message;
    return pki::bundle_in(site_.bundle_folder(wish));
  }
  /// One whose time is over.
  pki::BundleFiles issue_expired(const std::string& name, pki::Role role, const std::vector<std::string>& hosts = {}) {
    return issue(name, role, hosts, today() - std::chrono::hours(24 * 3), 1);
  }
  pki::BundleFiles robot() { return issue("r1", pki::Role::kRobot, {"127.0.0.1", "::1"}); }

  void revoke(const std::string& name) {
    const auto revoked = site_.revoke(name, today());
    EXPECT_TRUE(revoked) << revoked.error().message;
  }
  /// Brings the present list of revocations to a bundle, as an operator copies it.
  void copy_revocations(const pki::BundleFiles& to) const {
    std::filesystem::copy_file(folder_ / pki::kRevocationsName, to.revocations,
                               std::filesystem::copy_options::overwrite_existing);
  }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] pki::SiteAuthority& authority() { return site_; }

 private:
  static inline int made_ = 0;  ///< each has a folder of its own
  std::filesystem::path folder_;
  pki::SiteAuthority site_;
};

}  // namespace seeker::testing
