#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "client/cli/tls_bundle.hpp"
#include "tests/unit/client/cli/verbs_fixture.hpp"

namespace seeker::cli {
namespace {

using ::testing::HasSubstr;

class PkiVerbs : public VerbsFixture {
 protected:
  void SetUp() override {
    VerbsFixture::SetUp();
    connect_error = Error{Errc::kLinkLost, "must not be tried"};
    EXPECT_EQ(run({"pki", "init", path("site")}).code, 0);
  }
  Ran pki(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "pki");
    arguments.insert(arguments.end(), {"--site", path("site")});
    return run(arguments);
  }
};

TEST_F(PkiVerbs, ASiteIsMadeOnce) {
  const Ran again = run({"pki", "init", path("site")});
  EXPECT_EQ(again.code, 3);
  EXPECT_THAT(again.err, HasSubstr("--overwrite"));
  EXPECT_EQ(run({"pki", "init", path("site"), "--overwrite"}).code, 0);
}

TEST_F(PkiVerbs, ABundleIsAFolderWithFourFiles) {
  const Ran issued = pki({"issue", "r1", "--role", "robot", "--host", "10.0.0.5", "--out", path("r1")});
  EXPECT_EQ(issued.code, 0) << issued.err;
  EXPECT_THAT(issued.out, HasSubstr("r1  robot, valid, until "));
  EXPECT_THAT(issued.out, HasSubstr("at r1, 10.0.0.5"));
  for (const char* name : {"ca.pem", "cert.pem", "key.pem", "crl.pem"}) {
    EXPECT_THAT(read(std::string("r1/") + name), HasSubstr("-----BEGIN")) << name;
  }
  EXPECT_EQ(pki({"issue", "r1", "--role", "robot", "--out", path("r1")}).code, 3);
  EXPECT_EQ(pki({"issue", "r1", "--role", "robot", "--out", path("r1"), "--overwrite"}).code, 0);
}

TEST_F(PkiVerbs, ShowTellsAllThatTheSiteHasIssued) {
  pki({"issue", "anna", "--role", "operator"});
  pki({"issue", "olga", "--role", "observer", "--days", "2"});
  EXPECT_EQ(pki({"revoke", "anna"}).code, 0);
  const Ran shown = run({"pki", "show", path("site")});
  EXPECT_EQ(shown.code, 0);
  EXPECT_THAT(shown.out, HasSubstr("Seeker site  CA, valid"));
  EXPECT_THAT(shown.out, HasSubstr("anna  operator, revoked"));
  EXPECT_THAT(shown.out, HasSubstr("olga  observer, valid"));
  const Ran json = run({"--json", "pki", "show", path("site")});
  EXPECT_TRUE(is_json(json.out)) << json.out;
  EXPECT_THAT(json.out, HasSubstr("\"name\":\"anna\",\"role\":\"operator\",\"state\":\"revoked\",\"revoked\":true"));
}

TEST_F(PkiVerbs, ShowReadsABundleAndACertificate) {
  pki({"issue", "anna", "--role", "operator"});
  const std::string bundle = path("site/bundles/anna");
  EXPECT_THAT(run({"pki", "show", bundle}).out, HasSubstr("anna  operator, valid"));
  EXPECT_THAT(run({"pki", "show", bundle + "/cert.pem"}).out, HasSubstr("anna  operator, valid"));
  EXPECT_THAT(run({"pki", "show", bundle + "/ca.pem"}).out, HasSubstr("Seeker site  CA"));
  EXPECT_EQ(run({"pki", "show", path("board.png")}).code, 2);
  EXPECT_EQ(run({"pki", "show", path("none")}).code, 2);
}

TEST_F(PkiVerbs, WhatCannotBeIsAUsageError) {
  EXPECT_EQ(pki({"issue", "anna", "--role", "king"}).code, 2);
  EXPECT_EQ(pki({"issue", "an na", "--role", "operator"}).code, 2);
  EXPECT_EQ(pki({"issue", "anna", "--role", "operator", "--days", "0"}).code, 2);
  EXPECT_EQ(pki({"revoke", "nobody"}).code, 1);
  EXPECT_EQ(run({"pki", "issue", "anna", "--role", "operator", "--site", path("none")}).code, 2);
}

TEST_F(PkiVerbs, CallsAreMadeWithTheBundleThatIsNamed) {
  pki({"issue", "anna", "--role", "operator"});
  const std::string bundle = path("site/bundles/anna");
  const auto named = bundle_for(bundle, "127.0.0.1");
  ASSERT_TRUE(named && *named);
  EXPECT_EQ((*named)->certificate, bundle + "/cert.pem");
  EXPECT_EQ((*named)->revocations, bundle + "/crl.pem");
  EXPECT_FALSE(bundle_for("none", "10.0.0.5")->has_value());
  EXPECT_FALSE(bundle_for("", "127.0.0.1")->has_value()) << "a robot on this machine";
  EXPECT_EQ(bundle_for(path("none"), "10.0.0.5").error().code, Errc::kInvalidArgument);
}

}  // namespace
}  // namespace seeker::cli
