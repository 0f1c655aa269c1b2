// `seeker doctor` and `seeker audit` against a robot in memory.

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/unit/client/cli/cli_fixture.hpp"

namespace seeker::cli {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

class DoctorVerbs : public ::testing::Test, public CliFixture {
 protected:
  /// The verdict of each check by its name.
  std::map<std::string, std::string> verdicts(const Ran& ran) {
    std::map<std::string, std::string> all;
    const Json json = Json::parse(ran.out);
    for (const Json& check : json.at("checks")) {
      all[check.at("name")] = check.at("verdict");
    }
    return all;
  }
};

TEST_F(DoctorVerbs, ARobotThatIsWellGetsAnOkForEachCheck) {
  host->edit([](testing::FakeRobotValues& v) {
    v.diagnosis = {{"robot-disk", api::Verdict::kOk, "8000 MiB of 32000 MiB are free", ""}};
    v.status.timing = TickTiming{1000, 0, Duration{}};
    v.status.faults.clear();
  });
  const Ran ran = run({"doctor", "--json"});
  EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
  EXPECT_TRUE(Json::parse(ran.out).at("ok"));
  const auto all = verdicts(ran);
  for (const char* check : {"tls-files", "name", "session", "versions", "round-trip", "lease", "estop", "loop", "fault",
                            "device", "robot-disk"}) {
    ASSERT_TRUE(all.contains(check)) << check << " is missing in " << ran.out;
    EXPECT_EQ(all.at(check), "OK") << check;
  }
}

TEST_F(DoctorVerbs, WhatFailedOnTheRobotFailsTheCallAndSaysWhatToDo) {
  host->edit([](testing::FakeRobotValues& v) {
    v.diagnosis = {{"robot-disk", api::Verdict::kFailed, "1 MiB of 32000 MiB are free", "delete maps"}};
  });
  const Ran ran = run({"doctor"});
  EXPECT_EQ(ran.code, 1);
  EXPECT_THAT(ran.out, HasSubstr("FAILED   robot-disk         1 MiB of 32000 MiB are free; delete maps\n"));
}

TEST_F(DoctorVerbs, AnOlderRobotIsAWarning) {
  host->edit([](testing::FakeRobotValues& v) {
    v.info.protocol_minor = 5;
    v.diagnosis.reset();
    v.status.faults.clear();
  });
  const Ran ran = run({"doctor", "--json"});
  EXPECT_EQ(ran.code, 0) << ran.out;
  EXPECT_EQ(verdicts(ran).at("versions"), "WARNING");
  EXPECT_EQ(verdicts(ran).at("robot"), "WARNING");
}

TEST_F(DoctorVerbs, WithoutARobotItStillSaysWhatItCan) {
  connect_error = Error{Errc::kLinkLost, "nobody listens at 127.0.0.1:1; start seekerd"};
  const Ran ran = run({"doctor", "--robot", "127.0.0.1:1", "--json"});
  EXPECT_EQ(ran.code, 1);
  const auto all = verdicts(ran);
  EXPECT_EQ(all.at("tls-files"), "OK");
  EXPECT_EQ(all.at("name"), "OK");
  EXPECT_EQ(all.at("port"), "FAILED");
  EXPECT_FALSE(all.contains("session"));
}

TEST_F(DoctorVerbs, FilesThatAreNotThereEndTheExaminationBeforeTheWay) {
  const Ran ran = run({"doctor", "--tls", "/no-such-folder", "--json"});
  EXPECT_EQ(ran.code, 1);
  EXPECT_EQ(verdicts(ran).at("tls-files"), "FAILED");
  EXPECT_FALSE(verdicts(ran).contains("session"));
  EXPECT_EQ(run({"doctor", "--robot", "a b:c:d"}).code, 2) << "an address that is none is a wrong command line";
}

TEST_F(DoctorVerbs, AuditPrintsTheRecordsOfAClient) {
  api::AuditRecord record;
  record.number = 7;
  record.unix_ns = 1'764'359'273'250'000'000;
  record.stamp = robot_time_s(12.5);
  record.client = "anna/seeker";
  record.role = "operator";
  record.serial = "3f";
  record.address = "10.0.0.7:51234";
  record.call = "set_estop";
  record.essentials = "release";
  record.outcome = "refused";
  record.message = "an observer may not do this";
  host->edit([&](testing::FakeRobotValues& v) { v.audit = {record}; });
  const Ran text = run({"audit", "--last", "5", "--client", "anna"});
  EXPECT_EQ(text.code, 0);
  EXPECT_EQ(text.out,
            "2025-11-28T19:47:53.250Z  anna/seeker (operator, certificate 3f) at 10.0.0.7:51234: set_estop release: "
            "refused, an observer may not do this\n");
  EXPECT_EQ(host->values().audit_queries.back(), (api::AuditQuery{5, "anna"}));
  const Json json = Json::parse(run({"audit", "--json"}).out);
  EXPECT_EQ(json.at("records").at(0).at("number"), 7);
  EXPECT_EQ(json.at("records").at(0).at("time"), "2025-11-28T19:47:53.250Z");
  EXPECT_EQ(host->values().audit_queries.back().last, 20U);
  EXPECT_EQ(run({"audit", "--last", "0"}).code, 2);
}

TEST_F(DoctorVerbs, ARobotThatKeepsNoRecordsSaysSo) {
  host->edit([](testing::FakeRobotValues& v) { v.audit.reset(); });
  EXPECT_EQ(run({"audit"}).code, 3);
}

}  // namespace
}  // namespace seeker::cli
