#include "server/app/diagnosis/host_facts.hpp"

#include <sys/timex.h>
#include <unistd.h>

#include <fstream>
#include <sstream>
#include <system_error>

#include "common/files/files.hpp"

namespace seeker::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProbeName = ".write-probe";

Result<DiskFacts> disk_of(const fs::path& folder) {
  std::error_code error;
  const fs::space_info space = fs::space(folder, error);
  if (error) {
    return fail(Errc::kIo, "'" + folder.string() + "': " + error.message());
  }
  return DiskFacts{space.available, space.capacity};
}

Status try_to_write(const fs::path& folder) {
  const fs::path probe = folder / kProbeName;
  const Status written = files::write_file(probe, "written by the robot to see whether it can\n");
  std::error_code ignored;
  fs::remove(probe, ignored);
  return written;
}

/// The number of a line as "MemAvailable:  123 kB", in bytes.
std::optional<std::uint64_t> kib_line(const std::string& text, const std::string& key) {
  constexpr std::uint64_t kKib = 1024;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name;
    std::uint64_t value = 0;
    if (words >> name >> value && name == key) {
      return value * kKib;
    }
  }
  return std::nullopt;
}

/// Files of /proc have no size that could be asked for first.
std::string read_proc(const char* file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

Result<MemoryFacts> memory_of_machine() {
  const std::string machine = read_proc("/proc/meminfo");
  const auto available = kib_line(machine, "MemAvailable:");
  const auto total = kib_line(machine, "MemTotal:");
  const auto own = kib_line(read_proc("/proc/self/status"), "VmRSS:");
  if (!available || !total || !own) {
    return fail(Errc::kNotFound, "the system does not tell how much memory is free");
  }
  return MemoryFacts{*available, *total, *own};
}

ClockFacts clock_of_machine() {
  ClockFacts facts{std::chrono::system_clock::now(), std::nullopt};
  timex query{};
  if (::adjtimex(&query) >= 0) {
    facts.synchronised = (query.status & STA_UNSYNC) == 0;
  }
  return facts;
}

std::optional<Result<pki::CertificateFacts>> certificate_in(const fs::path& file) {
  if (file.empty()) {
    return std::nullopt;
  }
  const Result<pki::Certificate> certificate = pki::Certificate::read(file);
  return certificate ? Result<pki::CertificateFacts>(certificate->facts())
                     : Result<pki::CertificateFacts>(tl::unexpected<Error>(certificate.error()));
}

}  // namespace

HostFacts collect(const HostSources& sources) {
  return {.version = sources.version,
          .folder = sources.folder,
          .disk = disk_of(sources.folder),
          .writable = try_to_write(sources.folder),
          .memory = memory_of_machine(),
          .clock = clock_of_machine(),
          .journal = sources.journal ? std::optional(sources.journal()) : std::nullopt,
          .audit_lost = sources.audit_lost ? sources.audit_lost() : 0,
          .certificate = certificate_in(sources.certificate)};
}

}  // namespace seeker::app
