#include "server/app/diagnosis/host_findings.hpp"

#include <algorithm>
#include <functional>
#include <future>

#include <gmock/gmock.h>

#include "server/app/diagnosis/diagnosis_service.hpp"
#include "tests/unit/server/store/temporary_folder.hpp"

namespace seeker::app {
namespace {

using api::Verdict;
using std::chrono::hours;
using ::testing::HasSubstr;

/// Noon of 2026-06-01.
const pki::CalendarTime kNow = std::chrono::sys_days(std::chrono::year(2026) / 6 / 1) + hours(12);

pki::CertificateFacts certificate(pki::CalendarTime from, pki::CalendarTime until) {
  return {.name = "r1",
          .role = pki::Role::kRobot,
          .serial = "1",
          .issuer = "site",
          .not_before = from,
          .not_after = until,
          .hosts = {},
          .is_ca = false};
}

/// A machine on which all is well.
HostFacts healthy() {
  HostFacts facts;
  facts.version = "1.2.3";
  facts.folder = "/var/lib/seeker";
  facts.disk = DiskFacts{8ULL << 30U, 32ULL << 30U};
  facts.memory = MemoryFacts{2ULL << 30U, 4ULL << 30U, 100ULL << 20U};
  facts.clock = {kNow, true};
  facts.journal = JournalHealth{};
  facts.certificate = certificate(kNow - hours(24), kNow + hours(24 * 365));
  return facts;
}

api::Finding finding(const std::string& check, const std::function<void(HostFacts&)>& change) {
  HostFacts facts = healthy();
  change(facts);
  const std::vector<api::Finding> all = judge(facts);
  const auto found = std::find_if(all.begin(), all.end(), [&](const api::Finding& f) { return f.check == check; });
  EXPECT_NE(found, all.end()) << check;
  return found == all.end() ? api::Finding{} : *found;
}

/// It says what to do unless all is well.
void expect(Verdict verdict, const std::string& part, const api::Finding& finding) {
  EXPECT_EQ(finding.verdict, verdict) << finding.found;
  EXPECT_THAT(finding.found, HasSubstr(part));
  EXPECT_EQ(finding.remedy.empty(), verdict == Verdict::kOk) << finding.remedy;
}

TEST(HostFindings, AMachineOnWhichAllIsWellHasNothingButOk) {
  for (const api::Finding& one : judge(healthy())) {
    expect(Verdict::kOk, "", one);
    EXPECT_FALSE(one.found.empty());
  }
}

TEST(HostFindings, DiskAndMemoryWarnBeforeTheyFail) {
  const auto disk = [](std::uint64_t free) { return [free](HostFacts& f) { f.disk->free_bytes = free; }; };
  expect(Verdict::kOk, "512 MiB of", finding("robot-disk", disk(kFewDisk_bytes)));
  expect(Verdict::kWarning, "511 MiB of", finding("robot-disk", disk(kFewDisk_bytes - 1)));
  expect(Verdict::kFailed, "63 MiB of", finding("robot-disk", disk(kNoDisk_bytes - 1)));
  const auto memory = [](std::uint64_t free) { return [free](HostFacts& f) { f.memory->available_bytes = free; }; };
  expect(Verdict::kWarning, "127 MiB of", finding("robot-memory", memory(kFewMemory_bytes - 1)));
  expect(Verdict::kFailed, "31 MiB of", finding("robot-memory", memory(kNoMemory_bytes - 1)));
}

TEST(HostFindings, AFolderThatCannotBeWrittenFailsWithTheCause) {
  expect(Verdict::kFailed, "read-only",
         finding("robot-folder", [](HostFacts& f) { f.writable = fail(Errc::kIo, "the file system is read-only"); }));
}

TEST(HostFindings, AClockThatWasNeverSetFailsAndOneThatNobodyKeepsWarns) {
  expect(Verdict::kFailed, "1970-01-01", finding("robot-clock", [](HostFacts& f) { f.clock.now = {}; }));
  expect(Verdict::kWarning, "no time server",
         finding("robot-clock", [](HostFacts& f) { f.clock.synchronised = false; }));
  expect(Verdict::kOk, "does not say", finding("robot-clock", [](HostFacts& f) { f.clock.synchronised.reset(); }));
}

TEST(HostFindings, JournalAndTrailTellWhatWasLost) {
  expect(Verdict::kFailed, "disk is full", finding("robot-journal", [](HostFacts& f) {
           f.journal->failed = Error{Errc::kIo, "the disk is full"};
         }));
  expect(Verdict::kWarning, "7 entries", finding("robot-journal", [](HostFacts& f) { f.journal->dropped = 7; }));
  expect(Verdict::kWarning, "no journal", finding("robot-journal", [](HostFacts& f) { f.journal.reset(); }));
  expect(Verdict::kWarning, "3 records", finding("robot-audit", [](HostFacts& f) { f.audit_lost = 3; }));
}

TEST(HostFindings, ACertificateWarnsForAMonthAndThenFails) {
  const auto until = [](pki::CalendarTime end) {
    return [end](HostFacts& f) { f.certificate = certificate(kNow - hours(24), end); };
  };
  expect(Verdict::kOk, "valid until", finding("robot-certificate", until(kNow + pki::kExpiryWarning + hours(1))));
  expect(Verdict::kWarning, "expires on", finding("robot-certificate", until(kNow + pki::kExpiryWarning)));
  expect(Verdict::kFailed, "has expired", finding("robot-certificate", until(kNow)));
  expect(Verdict::kFailed, "is valid from", finding("robot-certificate", [](HostFacts& f) {
           f.certificate = certificate(kNow + hours(1), kNow + hours(10'000));
         }));
  expect(Verdict::kFailed, "cannot be read", finding("robot-certificate", [](HostFacts& f) {
           f.certificate = fail(Errc::kIo, "cert.pem cannot be read");
         }));
  expect(Verdict::kOk, "without TLS", finding("robot-certificate", [](HostFacts& f) { f.certificate.reset(); }));
}

TEST(DiagnosisService, LooksAtThisMachineAndLeavesNothingBehind) {
  const testing::TemporaryFolder folder;
  DiagnosisService service(
      {.version = "1.2.3", .folder = folder.path(), .certificate = {}, .journal = {}, .audit_lost = {}});
  std::promise<Result<std::vector<api::Finding>>> promise;
  service.ask([&](Result<std::vector<api::Finding>> findings) { promise.set_value(std::move(findings)); });
  const auto findings = promise.get_future().get();
  ASSERT_TRUE(findings) << findings.error().message;
  EXPECT_EQ(findings->size(), judge(healthy()).size());
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(DiagnosisService, AStateFolderThatIsNotThereFails) {
  const testing::TemporaryFolder folder;
  const HostFacts facts = collect(
      {.version = "1.2.3", .folder = folder.path() / "gone", .certificate = {}, .journal = {}, .audit_lost = {}});
  EXPECT_FALSE(facts.disk);
  EXPECT_FALSE(facts.writable);
}

}  // namespace
}  // namespace seeker::app
