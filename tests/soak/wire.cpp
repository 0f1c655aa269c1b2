// A bad cable between two network namespaces, packet by packet, as tc netem makes one where the kernel has it. Called
// by peers.sh: soak_wire NAMESPACE_A NAMESPACE_B DELAY_MS LOSS_PERCENT RATE_KBIT SEED. Runs until it is ended.

#include <fcntl.h>
#include <linux/if.h>
#include <linux/if_tun.h>
#include <poll.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <deque>
#include <iostream>
#include <string>
#include <vector>

#include "common/core/rng.hpp"
#include "common/core/time.hpp"

namespace {

using namespace seeker;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostQueued = 1000;  ///< packets, as netem's default
constexpr std::size_t kMostBytes = 65536;

/// A device "cableN" in the namespace, or -1.
int open_device(const std::string& name_space, int number) {
  const int inside = open(("/var/run/netns/" + name_space).c_str(), O_RDONLY | O_CLOEXEC);
  const bool entered = inside >= 0 && setns(inside, CLONE_NEWNET) == 0;
  close(inside);
  const int device = entered ? open("/dev/net/tun", O_RDWR | O_NONBLOCK | O_CLOEXEC) : -1;
  ifreq wish{};
  wish.ifr_flags = IFF_TUN | IFF_NO_PI;
  std::strncpy(wish.ifr_name, ("cable" + std::to_string(number)).c_str(), IFNAMSIZ - 1);
  return device >= 0 && ioctl(device, TUNSETIFF, &wish) == 0 ? device : -1;
}

struct Quality {
  Duration delay{};
  double loss = 0.0;
  double bytes_per_s = 0.0;
};

struct Packet {
  Clock::time_point due;
  std::vector<char> bytes;
};

/// One way of the cable.
class Way {
 public:
  Way(int from, int to, const Quality& quality) : from_(from), to_(to), quality_(quality) {}

  void take_in(Rng& rng) {
    std::array<char, kMostBytes> buffer{};
    for (ssize_t size = read(from_, buffer.data(), buffer.size()); size > 0;
         size = read(from_, buffer.data(), buffer.size())) {
      if (rng.uniform() < quality_.loss || on_the_way_.size() >= kMostQueued) {
        continue;
      }
      free_ = std::max(free_, Clock::now()) + seconds(static_cast<double>(size) / quality_.bytes_per_s);
      on_the_way_.push_back({free_ + quality_.delay, {buffer.begin(), buffer.begin() + size}});
    }
  }
  void let_out() {
    while (!on_the_way_.empty() && on_the_way_.front().due <= Clock::now()) {
      const std::vector<char>& bytes = on_the_way_.front().bytes;
      // A packet that the other side does not take is lost, as on any cable.
      static_cast<void>(!write(to_, bytes.data(), bytes.size()));
      on_the_way_.pop_front();
    }
  }
  [[nodiscard]] Clock::time_point next() const {
    return on_the_way_.empty() ? Clock::time_point::max() : on_the_way_.front().due;
  }

 private:
  int from_;
  int to_;
  Quality quality_;
  Clock::time_point free_;
  std::deque<Packet> on_the_way_;
};

int run(const std::array<int, 2>& devices, const Quality& quality, std::uint64_t seed) {
  Rng rng(seed);
  std::array<Way, 2> ways{Way(devices[0], devices[1], quality), Way(devices[1], devices[0], quality)};
  std::array<pollfd, 2> ready{pollfd{devices[0], POLLIN, 0}, pollfd{devices[1], POLLIN, 0}};
  constexpr Duration kLongest = std::chrono::seconds(1);
  for (;;) {
    const auto now = Clock::now();
    const auto next = std::min({ways[0].next(), ways[1].next(), now + kLongest});
    const auto wait_ms = std::chrono::ceil<std::chrono::milliseconds>(std::max(next - now, Clock::duration::zero()));
    if (poll(ready.data(), ready.size(), static_cast<int>(wait_ms.count())) < 0) {
      return 1;
    }
    for (Way& way : ways) {
      way.take_in(rng);
      way.let_out();
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 7) {
    std::cerr << "usage: soak_wire NAMESPACE_A NAMESPACE_B DELAY_MS LOSS_PERCENT RATE_KBIT SEED\n";
    return 2;
  }
  const std::array<int, 2> devices{open_device(argv[1], 0), open_device(argv[2], 1)};
  if (devices[0] < 0 || devices[1] < 0) {
    std::cerr << "no network device could be made: " << std::strerror(errno) << "\n";
    return 1;
  }
  constexpr double kBytesPerKbit = 1000.0 / 8.0;
  const Quality quality{seconds(std::stod(argv[3]) / 1000.0), std::stod(argv[4]) / 100.0,
                        std::stod(argv[5]) * kBytesPerKbit};
  return run(devices, quality, std::stoull(argv[6]));
}
