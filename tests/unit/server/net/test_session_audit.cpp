#include "server/net/session_audit.hpp"

#include <vector>

#include <gmock/gmock.h>

#include "common/wire/outcome.hpp"
#include "server/net/audit_text.hpp"

namespace seeker::server_net {
namespace {

namespace pb = ::seeker::v1;
using std::chrono::milliseconds;
using ::testing::HasSubstr;

class SessionAudits : public ::testing::Test {
 protected:
  [[nodiscard]] AuditClocks clocks() const {
    return {1'000'000 + now_.time_since_epoch().count(), RobotTime(now_.time_since_epoch()), now_};
  }
  pb::Request request(const std::function<void(pb::Request&)>& fill) {
    pb::Request request;
    request.mutable_header()->set_request_id(++id_);
    fill(request);
    return request;
  }
  static pb::Response response(const pb::Request& to, const Status& outcome = {}) {
    pb::Response response;
    response.mutable_header()->set_request_id(to.header().request_id());
    wire::set_outcome(response, static_cast<wire::CallNumber>(to.call_case()), outcome);
    return response;
  }
  /// It is asked for and answered.
  void command(const std::function<void(pb::Request&)>& fill, const Status& outcome = {}) {
    const pb::Request asked = request(fill);
    audit_.asked(asked, caller_, clocks());
    audit_.answered(response(asked, outcome), clocks());
  }
  void drive(double v_m_s, const Status& outcome = {}) {
    command([&](pb::Request& r) { r.mutable_drive()->mutable_command()->mutable_velocity()->set_v_m_s(v_m_s); },
            outcome);
  }
  void pass(Duration time) {
    now_ += time;
    audit_.tick(now_);
  }

  api::Caller caller_{"anna/seeker", api::Role::kOperator};
  wire::WallTime now_{};
  std::vector<api::AuditRecord> records_;
  pki::CertificateFacts certificate_{.name = "anna",
                                     .role = pki::Role::kOperator,
                                     .serial = "3f",
                                     .issuer = "site",
                                     .not_before = {},
                                     .not_after = {},
                                     .hosts = {},
                                     .is_ca = false};
  SessionAudit audit_{[this](const api::AuditRecord& record) { records_.push_back(record); }, "10.0.0.7:51234",
                      &certificate_};
  std::uint64_t id_ = 0;
};

TEST_F(SessionAudits, ARecordSaysWhoAskedForWhatWhenAndWhatCameOfIt) {
  pass(milliseconds(250));
  const AuditClocks asked_at = clocks();
  const pb::Request load = request([](pb::Request& r) {
    r.mutable_load_map()->set_name("hall");
    r.mutable_load_map()->set_use(pb::MAP_USE_LOCALISE);
  });
  audit_.asked(load, caller_, asked_at);
  EXPECT_TRUE(records_.empty()) << "its outcome is not known yet";
  pass(milliseconds(100));
  audit_.answered(response(load, fail(Errc::kBusy, "a mission\nruns; stop it")), clocks());
  ASSERT_EQ(records_.size(), 1U);
  const api::AuditRecord expected{.number = 0,
                                  .unix_ns = asked_at.unix_ns,
                                  .stamp = asked_at.robot,
                                  .client = "anna/seeker",
                                  .role = "operator",
                                  .certificate = "anna",
                                  .serial = "3f",
                                  .address = "10.0.0.7:51234",
                                  .call = "load_map",
                                  .essentials = "'hall' to localise",
                                  .outcome = "busy",
                                  .message = "a mission runs; stop it"};
  EXPECT_EQ(records_.front(), expected);
}

TEST_F(SessionAudits, CallsThatChangeNothingLeaveNoRecord) {
  command([](pb::Request& r) { r.mutable_get_status(); });
  command([](pb::Request& r) { r.mutable_get_audit(); });
  command([](pb::Request& r) { r.mutable_subscribe(); });
  EXPECT_TRUE(records_.empty());
}

TEST_F(SessionAudits, ASpellOfDrivingIsItsBeginningAndItsEnd) {
  for (int k = 0; k < 50; ++k) {
    drive(0.01 * k);
    pass(milliseconds(100));
  }
  EXPECT_EQ(records_.size(), 1U);
  pass(wire::kAuditRowGap);
  ASSERT_EQ(records_.size(), 2U);
  EXPECT_EQ(records_[0].essentials, "0.00 m/s, 0.00 rad/s");
  EXPECT_EQ(records_[1].essentials, "the last of 50 in 4.9 s: 0.49 m/s, 0.00 rad/s");
  EXPECT_GT(records_[1].stamp, records_[0].stamp);
  drive(0.3);
  EXPECT_EQ(records_.size(), 3U) << "the next spell begins";
}

TEST_F(SessionAudits, DrivingThatIsRefusedInBetweenIsASpellOfItsOwn) {
  for (int k = 0; k < 10; ++k) {
    drive(0.2, k % 2 == 0 ? Status() : Status(fail(Errc::kRefused, "the lease is another's")));
  }
  ASSERT_EQ(records_.size(), 2U);
  EXPECT_EQ(records_[0].outcome, "ok");
  EXPECT_EQ(records_[1].outcome, "refused");
  pass(wire::kAuditRowGap);
  EXPECT_EQ(records_.size(), 4U);
}

TEST_F(SessionAudits, CommandsThatAskForDifferentThingsAreAllRecorded) {
  command([](pb::Request& r) { r.mutable_set_estop()->set_engaged(true); });
  command([](pb::Request& r) { r.mutable_set_estop()->set_release(true); });
  command([](pb::Request& r) { r.mutable_delete_map()->set_name("a"); });
  command([](pb::Request& r) { r.mutable_delete_map()->set_name("b"); });
  pass(wire::kAuditRowGap);
  ASSERT_EQ(records_.size(), 4U);
  EXPECT_EQ(records_[0].essentials, "engage");
  EXPECT_EQ(records_[1].essentials, "release");
}

TEST_F(SessionAudits, AClientThatIsRefusedAgainAndAgainDoesNotFloodTheTrail) {
  for (int k = 0; k < 1000; ++k) {
    const pb::Request asked =
        request([&](pb::Request& r) { r.mutable_delete_map()->set_name("map-" + std::to_string(k)); });
    pb::Response refusal;
    wire::set_common_error(refusal, pb::CommonError::CODE_REFUSED, "an observer may not do this");
    audit_.refused(asked, refusal, {"olga", api::Role::kObserver}, clocks());
    pass(milliseconds(5));
  }
  EXPECT_EQ(records_.size(), 1U);
  pass(wire::kAuditRowGap);
  ASSERT_EQ(records_.size(), 2U);
  EXPECT_THAT(records_.back().essentials, HasSubstr("the last of 1000 in 5.0 s: 'map-999'"));
  EXPECT_EQ(records_.back().role, "observer");
}

TEST_F(SessionAudits, ASessionThatEndsLeavesNoCommandOut) {
  drive(0.1);
  drive(0.2);
  audit_.asked(request([](pb::Request& r) { r.mutable_stop(); }), caller_, clocks());
  audit_.end(clocks());
  ASSERT_EQ(records_.size(), 3U);
  EXPECT_EQ(records_[1].outcome, "unknown");
  EXPECT_THAT(records_[2].essentials, HasSubstr("the last of 2"));
  audit_.end(clocks());
  EXPECT_EQ(records_.size(), 3U);
}

TEST_F(SessionAudits, AnIdThatIsUsedTwiceHidesNothing) {
  const pb::Request first = request([](pb::Request& r) { r.mutable_delete_map()->set_name("a"); });
  --id_;
  const pb::Request second = request([](pb::Request& r) { r.mutable_set_estop()->set_release(true); });
  ASSERT_EQ(first.header().request_id(), second.header().request_id());
  audit_.asked(first, caller_, clocks());
  audit_.asked(second, caller_, clocks());
  audit_.answered(response(second), clocks());
  audit_.answered(response(first, fail(Errc::kNotFound, "no such map")), clocks());
  ASSERT_EQ(records_.size(), 2U);
  EXPECT_EQ(records_[0].call, "set_estop");
  EXPECT_EQ(records_[1].call, "delete_map");
  EXPECT_EQ(records_[1].outcome, "not_found");
}

TEST(AuditText, WhatClientsSendIsOneShortLine) {
  pb::Request request;
  request.mutable_set_settings()->set_component("lidar\n2026 forged");
  request.mutable_set_settings()->add_assignments(std::string(5000, 'x'));
  const std::optional<std::string> text = audit_essentials(request);
  ASSERT_TRUE(text);
  EXPECT_EQ(text->find('\n'), std::string::npos);
  EXPECT_EQ(text->size(), api::kMaxAuditEssentials_bytes);
}

TEST(AuditText, MissionsAreNamedWithTheirTask) {
  pb::Request request;
  pb::MissionRequest* mission = request.mutable_start_mission()->mutable_mission();
  mission->set_id("m1");
  EXPECT_EQ(audit_essentials(request), "mission 'm1': ?");
  mission->mutable_search()->add_targets()->set_name("cross");
  EXPECT_EQ(audit_essentials(request), "mission 'm1': search for 'cross'");
  mission->mutable_explore();
  EXPECT_EQ(audit_essentials(request), "mission 'm1': explore");
}

}  // namespace
}  // namespace seeker::server_net
