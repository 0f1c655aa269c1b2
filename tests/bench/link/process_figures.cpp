#include "tests/bench/link/process_figures.hpp"

#include <arpa/inet.h>
#include <linux/tcp.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <charconv>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/support/process_memory.hpp"

namespace seeker::link_bench {
namespace {

namespace fs = std::filesystem;

constexpr double kNsPerS = 1e9;

/// Of /proc/PID/stat, counted behind the program's name, which may hold spaces: user and system time are the 12th and
/// 13th.
constexpr int kWordsBeforeTimes = 11;

double processor_s(const fs::path& process) {
  std::ifstream in(process / "stat");
  std::string line;
  std::getline(in, line);
  const std::size_t name_end = line.rfind(')');
  if (name_end == std::string::npos) {
    return 0.0;
  }
  std::istringstream words(line.substr(name_end + 1));
  std::string skipped;
  for (int k = 0; k < kWordsBeforeTimes; ++k) {
    words >> skipped;
  }
  double user = 0.0;
  double system = 0.0;
  words >> user >> system;
  return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

double waited_s(const fs::path& process) {
  double ns = 0.0;
  std::error_code gone;
  for (const auto& task : fs::directory_iterator(process / "task", gone)) {
    std::ifstream in(task.path() / "schedstat");
    double ran = 0.0;
    double waited = 0.0;
    in >> ran >> waited;
    ns += waited;
  }
  return ns / kNsPerS;
}

bool leads_to(int socket, std::uint16_t port) {
  sockaddr_in peer{};
  socklen_t size = sizeof peer;
  return getpeername(socket, reinterpret_cast<sockaddr*>(&peer), &size) == 0 && ntohs(peer.sin_port) == port;
}

}  // namespace

ProcessFigures figures_of(pid_t process) {
  const fs::path folder = fs::path("/proc") / std::to_string(process);
  const long resident_kib = testing::memory_kb(process, "VmRSS").value_or(0);
  return {processor_s(folder), waited_s(folder), static_cast<double>(resident_kib)};
}

std::uint64_t bytes_received_from(std::uint16_t port) {
  std::uint64_t sum = 0;
  for (const auto& entry : fs::directory_iterator("/proc/self/fd")) {
    const std::string name = entry.path().filename().string();
    int file = -1;
    std::from_chars(name.data(), name.data() + name.size(), file);
    tcp_info info{};
    socklen_t size = sizeof info;
    if (leads_to(file, port) && getsockopt(file, IPPROTO_TCP, TCP_INFO, &info, &size) == 0) {
      sum += info.tcpi_bytes_received;
    }
  }
  return sum;
}

}  // namespace seeker::link_bench
