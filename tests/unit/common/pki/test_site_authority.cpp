#include "common/pki/site_authority.hpp"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <openssl/pem.h>

#include "common/pki/bundle.hpp"
#include "common/pki/private_key.hpp"
#include "common/pki/site_lock.hpp"
#include "tests/support/process.hpp"

namespace seeker::pki {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr fs::perms kOwnerReads = fs::perms::owner_read | fs::perms::owner_write;

class Site : public ::testing::Test {
 protected:
  Result<Issued> issue(const std::string& name, Role role = Role::kOperator, std::vector<std::string> hosts = {}) {
    BundleWish wish;
    wish.name = name;
    wish.role = role;
    wish.hosts = std::move(hosts);
    return site_.issue(wish, now_);
  }
  [[nodiscard]] fs::path bundle(const std::string& name) const { return folder_ / "bundles" / name; }

  CalendarTime now_ = std::chrono::system_clock::now();
  fs::path folder_ = testing::fresh_folder("pki") / "site";
  SiteAuthority site_ = SiteAuthority::init(folder_, {}, now_).value();
};

TEST_F(Site, KeysAreReadableByTheirOwnerAlone) {
  ASSERT_TRUE(issue("anna"));
  EXPECT_EQ(fs::status(folder_ / "ca.key").permissions(), kOwnerReads);
  EXPECT_EQ(fs::status(bundle("anna") / kKeyName).permissions(), kOwnerReads);
  EXPECT_EQ(fs::status(folder_).permissions(), fs::perms::owner_all);
  EXPECT_EQ(fs::status(bundle("anna")).permissions(), fs::perms::owner_all);
}

TEST_F(Site, AnExistingCaIsReplacedOnlyOnRequest) {
  const std::string before = *read_pem(folder_ / kCaName);
  const auto refused = SiteAuthority::init(folder_, {}, now_);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::kRefused);
  EXPECT_EQ(*read_pem(folder_ / kCaName), before);
  ASSERT_TRUE(issue("anna"));
  CaWish wish;
  wish.overwrite = true;
  const auto replaced = SiteAuthority::init(folder_, wish, now_);
  ASSERT_TRUE(replaced);
  EXPECT_NE(*read_pem(folder_ / kCaName), before);
  EXPECT_TRUE(replaced->list()->empty()) << "what the former CA has issued is void";
}

TEST_F(Site, ACertificateSaysNameRoleHostsAndValidity) {
  const auto issued = issue("r1", Role::kRobot, {"10.0.0.5", "r1.local", "fd00::1"});
  ASSERT_TRUE(issued) << issued.error().message;
  const auto read = Certificate::read(bundle("r1") / kCertificateName);
  ASSERT_TRUE(read);
  const CertificateFacts& facts = read->facts();
  EXPECT_EQ(facts.name, "r1");
  EXPECT_EQ(facts.role, Role::kRobot);
  EXPECT_THAT(facts.hosts, ElementsAre("r1", "10.0.0.5", "r1.local", "fd00::1"));
  EXPECT_EQ(facts.issuer, "Seeker site");
  EXPECT_EQ(facts.serial.size(), 32U);
  EXPECT_FALSE(facts.is_ca);
  EXPECT_LT(facts.not_before, now_);
  EXPECT_NEAR(std::chrono::duration<double>(facts.not_after - now_).count(), 365.0 * 86400, 2.0);
  EXPECT_TRUE(site_.ca().is_ca);
}

TEST_F(Site, ABundleIsRenewedOnlyOnRequest) {
  ASSERT_TRUE(issue("anna"));
  const std::string key = *read_pem(bundle("anna") / kKeyName);
  const auto refused = issue("anna");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::kRefused);
  EXPECT_EQ(*read_pem(bundle("anna") / kKeyName), key);
  BundleWish wish;
  wish.name = "anna";
  wish.overwrite = true;
  ASSERT_TRUE(site_.issue(wish, now_));
  EXPECT_NE(*read_pem(bundle("anna") / kKeyName), key);
  EXPECT_EQ(site_.list()->size(), 2U) << "the former one can still be revoked";
}

TEST_F(Site, ACertificateEndsWithItsCa) {
  BundleWish wish;
  wish.name = "anna";
  wish.days = 36500;
  const auto issued = site_.issue(wish, now_);
  ASSERT_TRUE(issued);
  EXPECT_EQ(issued->facts.not_after, site_.ca().not_after);
}

TEST_F(Site, RevokingByNameTakesAllOfThatName) {
  ASSERT_TRUE(issue("anna"));
  BundleWish again;
  again.name = "anna";
  again.overwrite = true;
  ASSERT_TRUE(site_.issue(again, now_));
  ASSERT_TRUE(issue("bob"));
  const auto revoked = site_.revoke("anna", now_);
  ASSERT_TRUE(revoked);
  EXPECT_EQ(revoked->size(), 2U);
  const auto listed = site_.list();
  ASSERT_TRUE(listed);
  for (const Issued& one : *listed) {
    EXPECT_EQ(one.revoked, one.facts.name == "anna") << one.facts.name;
  }
  const auto list = RevocationList::read(folder_ / kRevocationsName);
  ASSERT_TRUE(list);
  EXPECT_EQ(list->size(), 2);
  EXPECT_TRUE(site_.revoke("anna", now_)->empty()) << "nothing is left to revoke";
}

TEST_F(Site, RevokingBySerialTakesThatOne) {
  const auto first = issue("anna");
  ASSERT_TRUE(issue("bob"));
  const auto revoked = site_.revoke(first->facts.serial, now_);
  ASSERT_TRUE(revoked);
  ASSERT_EQ(revoked->size(), 1U);
  EXPECT_EQ(revoked->front().facts.name, "anna");
  EXPECT_EQ(site_.revoke("nobody", now_).error().code, Errc::kNotFound);
}

TEST_F(Site, NamesAndHostsThatAreNoneAreRefused) {
  for (const char* name : {"", "../x", "a b", "-a", "a/b", "abcdefghijklmnopqrstuvwxyz0123456"}) {
    EXPECT_EQ(issue(name).error().code, Errc::kInvalidArgument) << name;
  }
  for (const char* host : {"", "a b", "x,IP:1.2.3.4", "10.0.0.5/8", "-x"}) {
    EXPECT_EQ(issue("r1", Role::kRobot, {host}).error().code, Errc::kInvalidArgument) << host;
  }
  BundleWish wish;
  wish.name = "anna";
  wish.days = 0;
  EXPECT_EQ(site_.issue(wish, now_).error().code, Errc::kInvalidArgument);
}

TEST_F(Site, TwoProgramsDoNotChangeItAtOnce) {
  const auto lock = SiteLock::take(folder_);
  ASSERT_TRUE(lock);
  EXPECT_EQ(issue("anna").error().code, Errc::kBusy);
  EXPECT_EQ(site_.revoke("anna", now_).error().code, Errc::kBusy);
}

TEST_F(Site, AKeyOfAnotherCaIsNoticed) {
  const fs::path other = testing::fresh_folder("pki-other") / "site";
  ASSERT_TRUE(SiteAuthority::init(other, {}, now_));
  fs::copy_file(other / "ca.key", folder_ / "ca.key", fs::copy_options::overwrite_existing);
  EXPECT_EQ(SiteAuthority::open(folder_).error().code, Errc::kCorrupt);
  EXPECT_EQ(SiteAuthority::open(folder_ / "nothing").error().code, Errc::kNotFound);
}

TEST_F(Site, DamagedFilesAreErrorsWithTheirNames) {
  for (const std::string& bytes : {std::string(), std::string("garbage"), std::string(100, '\0'),
                                   std::string("-----BEGIN CERTIFICATE-----\nAAAA\n-----END CERTIFICATE-----\n")}) {
    const fs::path file = testing::fresh_folder("pki") / "file.pem";
    std::ofstream(file, std::ios::binary) << bytes;
    EXPECT_EQ(Certificate::read(file).error().code, Errc::kCorrupt);
    EXPECT_THAT(Certificate::read(file).error().message, HasSubstr(file.string()));
    EXPECT_EQ(RevocationList::read(file).error().code, Errc::kCorrupt);
    EXPECT_EQ(read_key(file).error().code, Errc::kCorrupt);
  }
}

TEST_F(Site, AKeyWithAPassphraseIsRefusedWithoutAskingForIt) {
  const KeyPtr key = make_key().value();
  const BioPtr out(BIO_new(BIO_s_mem()));
  std::string word = "secret";
  ASSERT_EQ(PEM_write_bio_PKCS8PrivateKey(out.get(), key.get(), EVP_aes_128_cbc(), word.data(),
                                          static_cast<int>(word.size()), nullptr, nullptr),
            1);
  const fs::path file = testing::fresh_folder("pki") / kKeyName;
  std::ofstream(file) << text_of(out.get());
  const auto read = read_key(file);
  ASSERT_FALSE(read);
  EXPECT_THAT(read.error().message, HasSubstr("passphrase"));
}

}  // namespace
}  // namespace seeker::pki
