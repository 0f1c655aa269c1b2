#include "server/app/diagnosis/host_findings.hpp"

namespace seeker::app {
namespace {

using api::failed_finding;
using api::Finding;
using api::Verdict;

std::string mib(std::uint64_t bytes) { return std::to_string(bytes >> 20U) + " MiB"; }

/// Of an amount that should not be small.
Verdict of_amount(std::uint64_t amount, std::uint64_t few, std::uint64_t none) {
  return amount < none ? Verdict::kFailed : amount < few ? Verdict::kWarning : Verdict::kOk;
}

Finding judge_disk(const HostFacts& facts) {
  const std::string remedy =
      "delete maps and landmarks that nobody needs ('seeker map list', 'seeker landmarks info'), or give --state a "
      "folder on a larger disk";
  if (!facts.disk) {
    return failed_finding("robot-disk", facts.disk.error(), "look whether the disk of the state folder is mounted");
  }
  const Verdict verdict = of_amount(facts.disk->free_bytes, kFewDisk_bytes, kNoDisk_bytes);
  return {"robot-disk", verdict,
          mib(facts.disk->free_bytes) + " of " + mib(facts.disk->total_bytes) + " are free for '" +
              facts.folder.string() + "'",
          verdict == Verdict::kOk ? "" : remedy};
}

Finding judge_folder(const HostFacts& facts) {
  if (!facts.writable) {
    return failed_finding("robot-folder", facts.writable.error(),
                          "free space there, and let the user that runs seekerd write into the state folder");
  }
  return {"robot-folder", Verdict::kOk, "the state folder '" + facts.folder.string() + "' can be written", ""};
}

Finding judge_memory(const HostFacts& facts) {
  if (!facts.memory) {
    return {"robot-memory", Verdict::kWarning, facts.memory.error().message, "look at the machine with 'free'"};
  }
  const MemoryFacts& memory = *facts.memory;
  const Verdict verdict = of_amount(memory.available_bytes, kFewMemory_bytes, kNoMemory_bytes);
  return {"robot-memory", verdict,
          mib(memory.available_bytes) + " of " + mib(memory.total_bytes) + " are free, seekerd uses " +
              mib(memory.own_bytes),
          verdict == Verdict::kOk ? "" : "end other programs on the robot, or restart it"};
}

int year_of(pki::CalendarTime time) {
  return static_cast<int>(std::chrono::year_month_day(std::chrono::floor<std::chrono::days>(time)).year());
}

Finding judge_clock(const ClockFacts& clock) {
  const std::string shown = "the robot's clock shows " + pki::date_text(clock.now);
  if (year_of(clock.now) < kFirstYear) {
    return {"robot-clock", Verdict::kFailed, shown + ": it was never set, and certificates are not valid then",
            "set it ('timedatectl set-time'), and let a time server keep it ('timedatectl set-ntp true')"};
  }
  if (clock.synchronised == false) {
    return {"robot-clock", Verdict::kWarning, shown + "; no time server keeps it",
            "let one do so ('timedatectl set-ntp true'): logs of several machines are compared by their clocks"};
  }
  return {"robot-clock", Verdict::kOk,
          shown + (clock.synchronised ? " and is kept by a time server" : "; the kernel does not say who keeps it"),
          ""};
}

Finding judge_journal(const std::optional<JournalHealth>& journal) {
  if (!journal) {
    return {"robot-journal", Verdict::kWarning, "the robot keeps no journal", "start seekerd with --state FOLDER"};
  }
  if (journal->failed) {
    return failed_finding("robot-journal", *journal->failed, kJournalRemedy);
  }
  if (journal->dropped > 0) {
    return {"robot-journal", Verdict::kWarning,
            std::to_string(journal->dropped) + " entries of the journal were lost: the disk does not follow",
            "take a faster disk for the state folder"};
  }
  return {"robot-journal", Verdict::kOk,
          "the journal was sound when it was opened, nothing was lost since, " + std::to_string(journal->waiting) +
              " entries wait",
          ""};
}

Finding judge_audit(std::uint64_t lost) {
  if (lost > 0) {
    return {"robot-audit", Verdict::kWarning, std::to_string(lost) + " records of who commanded what were lost",
            "free space on the disk of the state folder"};
  }
  return {"robot-audit", Verdict::kOk, "every command since the start is recorded ('seeker audit')", ""};
}

Finding judge_certificate(const std::optional<Result<pki::CertificateFacts>>& certificate, pki::CalendarTime now) {
  const std::string check = "robot-certificate";
  const std::string again =
      "issue it again ('seeker pki issue --overwrite') and copy it to the robot; no restart is needed";
  if (!certificate) {
    return {check, Verdict::kOk, "the robot listens without TLS and has no certificate", ""};
  }
  if (!*certificate) {
    return failed_finding(check, certificate->error(), again);
  }
  const pki::CertificateFacts& facts = **certificate;
  const std::string until = "the robot's certificate '" + facts.name + "' ";
  if (facts.not_after <= now) {
    return {check, Verdict::kFailed, until + "has expired on " + pki::date_text(facts.not_after), again};
  }
  if (facts.not_before > now) {
    return {check, Verdict::kFailed, until + "is valid from " + pki::date_text(facts.not_before) + " on only",
            "set the robot's clock, or that of the machine that has issued it"};
  }
  const bool soon = pki::expires_soon(facts.not_after, now);
  return {check, soon ? Verdict::kWarning : Verdict::kOk,
          until + (soon ? "expires on " : "is valid until ") + pki::date_text(facts.not_after), soon ? again : ""};
}

}  // namespace

std::vector<Finding> judge(const HostFacts& facts) {
  return {{"robot-version", Verdict::kOk, "seekerd " + facts.version, ""},
          judge_disk(facts),
          judge_folder(facts),
          judge_memory(facts),
          judge_clock(facts.clock),
          judge_journal(facts.journal),
          judge_audit(facts.audit_lost),
          judge_certificate(facts.certificate, facts.clock.now)};
}

}  // namespace seeker::app
