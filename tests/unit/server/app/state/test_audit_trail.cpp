#include "server/app/state/audit_trail.hpp"

#include <future>

#include <gmock/gmock.h>

#include "common/log/log.hpp"
#include "tests/unit/server/store/temporary_folder.hpp"

namespace seeker::app {
namespace {

using ::testing::HasSubstr;
using Records = std::vector<api::AuditRecord>;

api::AuditRecord record_of(const std::string& client, const std::string& call) {
  api::AuditRecord record;
  record.unix_ns = 1'764'359'273'000'000'000;
  record.stamp = robot_time_s(12.5);
  record.client = client;
  record.role = "operator";
  record.certificate = "anna";
  record.serial = "3f";
  record.address = "10.0.0.7:51234";
  record.call = call;
  record.essentials = "engage";
  record.outcome = "ok";
  return record;
}

Result<Records> newest(AuditTrail& trail, std::uint32_t last, const std::string& client = "") {
  std::promise<Result<Records>> promise;
  trail.newest({last, client}, [&](Result<Records> records) { promise.set_value(std::move(records)); });
  return promise.get_future().get();
}

TEST(AuditTrail, WhatWasNotedIsThereAtOnceAndAfterTheEnd) {
  const testing::TemporaryFolder folder;
  const log::ScopedSink quiet([](const log::Line&) {});
  api::AuditRecord expected = record_of("anna/seeker", "set_estop");
  {
    const auto trail = AuditTrail::open(folder.path()).value();
    trail->note(expected);
    expected.number = 1;
    EXPECT_EQ(newest(*trail, 10).value(), Records{expected});
    for (int k = 0; k < 500; ++k) {
      trail->note(record_of("ben", "stop"));
    }
  }
  const auto trail = AuditTrail::open(folder.path()).value();
  EXPECT_EQ(newest(*trail, 1000).value().size(), 501U);
  EXPECT_EQ(newest(*trail, 1000, "anna").value(), Records{expected});
  EXPECT_EQ(newest(*trail, 3).value().back().number, 501U);
  EXPECT_EQ(trail->lost(), 0U);
}

TEST(AuditTrail, EveryRecordIsALineOfTheLog) {
  const testing::TemporaryFolder folder;
  std::vector<std::string> lines;
  const log::ScopedSink sink([&](const log::Line& line) { lines.push_back(line.text); });
  {
    const auto trail = AuditTrail::open(folder.path()).value();
    trail->note(record_of("anna/seeker", "set_estop"));
  }
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines.front(), "'anna/seeker' (operator) at 10.0.0.7:51234: set_estop engage: ok");
}

}  // namespace
}  // namespace seeker::app
