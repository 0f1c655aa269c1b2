// How old a device's packet is when the robot has its value: over a pseudo-terminal and over a TCP port of this
// computer, from the moment before its last byte is written.
//   delivery: until the driver's read() can return it. That is the system's and the driver's part.
//   tick: until a loop with the robot's period has it. The wait for the tick is the greater part, and it is inherent.
#include <sys/prctl.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <benchmark/benchmark.h>

#include "common/log/log.hpp"
#include "server/drivers/hardware/hardware_devices.hpp"
#include "server/emulator/devices/lms_device.hpp"
#include "server/emulator/devices/p2os_device.hpp"
#include "server/emulator/pseudo_terminal.hpp"
#include "server/emulator/tcp_line.hpp"
#include "server/protocols/lms200/scan_telegram.hpp"
#include "server/protocols/lms200/telegram.hpp"
#include "server/protocols/p2os/sip.hpp"
#include "tests/support/quantile.hpp"

namespace {

using namespace seeker;  // NOLINT: a benchmark is one small program
using Wall = std::chrono::steady_clock;
using Bytes = std::vector<std::uint8_t>;

/// As LoopParams::period.
constexpr Duration kTick = std::chrono::milliseconds(100);
/// Both devices are 0.7 % fast, so that their packets fall everywhere between two ticks.
constexpr Duration kScanPeriod = std::chrono::microseconds(26480);
constexpr Duration kInformationPeriod = std::chrono::microseconds(99300);
constexpr std::int64_t kPackets = 400;
constexpr std::int64_t kTicks = 250;
constexpr std::uint32_t kLidarBaud = 500000;
constexpr unsigned kBeams = 361;
/// The first beam of packet n has kFirstRange_mm + n, so that a scan shows which one it is.
constexpr unsigned kFirstRange_mm = 1000;
constexpr Duration kHandshakeLimit = std::chrono::seconds(30);
constexpr Duration kPacketLimit = std::chrono::seconds(1);
constexpr Duration kPollPause = std::chrono::microseconds(10);

/// A driver, and the device at the other end of its line.
struct Talk {
  std::unique_ptr<emulator::DeviceLine> line;
  std::unique_ptr<emulator::EmulatedDevice> device;  ///< plays the handshake; then the benchmark sends in its place
  drivers::HardwareDevices host;
  std::shared_ptr<drivers::Driver> driver;
  std::function<Bytes(unsigned)> packet;            ///< one that shows its number
  std::function<std::optional<unsigned>()> newest;  ///< reads the driver: the number of the newest packet
  Duration period{};
};

std::unique_ptr<emulator::DeviceLine> terminal() {
  const std::string name = "seeker-latency-" + std::to_string(::getpid());
  return std::make_unique<emulator::PseudoTerminal>(std::filesystem::temp_directory_path() / name);
}

std::unique_ptr<emulator::DeviceLine> tcp() { return std::make_unique<emulator::TcpLine>("127.0.0.1", 0); }

bool has_baud(const emulator::DeviceLine& line) { return line.address().find("tcp://") != 0; }

Talk base(std::unique_ptr<emulator::DeviceLine> line) {
  Talk talk;
  emulator::P2osDeviceParams params;
  params.baud = has_baud(*line) ? params.baud : 0;
  const emulator::P2osDeviceHooks hooks{
      [](RobotTime) { return sim::BaseReading{}; }, [](RobotTime) { return SonarScan{}; }, [](const Twist2&) {}, {}};
  talk.device = std::make_unique<emulator::P2osDevice>(params, hooks, RobotTime());
  drivers::HardwareSettings settings;
  settings.base.port = line->address();
  talk.line = std::move(line);
  talk.host = drivers::make_hardware(settings).value();
  talk.driver = talk.host.base;
  talk.packet = [](unsigned number) {
    p2os::Sip sip;
    sip.ports = 0;
    sip.analog = sip.digital_in = sip.digital_out = std::uint8_t{0};
    sip.battery_x10 = static_cast<std::uint16_t>(number);
    return p2os::encode(p2os::write_sip(sip));
  };
  talk.newest = [base = talk.host.base]() -> std::optional<unsigned> {
    const auto sample = base->read().value();
    return sample ? std::optional(static_cast<unsigned>(std::lround(10.0 * sample->battery_v.value()))) : std::nullopt;
  };
  talk.period = kInformationPeriod;
  return talk;
}

LaserScan empty_room(RobotTime now) {
  LaserScan scan;
  scan.stamp = now;
  scan.angle_min_rad = -std::numbers::pi / 2.0;
  scan.angle_step_rad = std::numbers::pi / (kBeams - 1);
  scan.range_max_m = 8.0;
  scan.ranges_m.assign(kBeams, 1.0F);
  return scan;
}

Bytes scan_telegram(unsigned number) {
  lms200::ScanTelegram scan;
  scan.unit = lms200::Unit::kMillimetre;
  scan.words.assign(kBeams, static_cast<std::uint16_t>(kFirstRange_mm + number));
  return lms200::encode_telegram(lms200::Sender::kDevice, lms200::encode(scan, lms200::StatusByte::kGood));
}

Talk lidar(std::unique_ptr<emulator::DeviceLine> line) {
  Talk talk;
  emulator::LmsDeviceParams params;
  params.flash.unit = static_cast<std::uint8_t>(lms200::Unit::kMillimetre);
  params.power_on_baud = kLidarBaud;
  talk.device = std::make_unique<emulator::LmsDevice>(params, empty_room);
  drivers::HardwareSettings settings;
  settings.lidar.emplace();
  settings.lidar->port = line->address();
  settings.lidar->lms200.baud = kLidarBaud;
  talk.line = std::move(line);
  talk.host = drivers::make_hardware(settings).value();
  talk.driver = talk.host.lidar;
  talk.packet = scan_telegram;
  talk.newest = [lidar = talk.host.lidar]() -> std::optional<unsigned> {
    const auto scan = lidar->read().value();
    return scan ? std::optional(static_cast<unsigned>(std::lround(1000.0F * scan->ranges_m.at(0))) - kFirstRange_mm)
                : std::nullopt;
  };
  talk.period = kScanPeriod;
  return talk;
}

/// The device plays for one millisecond. Bytes at another rate than its own are lost.
void play(Talk& talk) {
  const RobotTime now = talk.host.clock->now();
  const bool understood = talk.line->host_baud() == 0 || talk.line->host_baud() == talk.device->baud();
  if (const Bytes heard = talk.line->receive(); understood) {
    talk.device->receive(heard, now);
  }
  talk.device->pass(now);
  if (const Bytes said = talk.device->take_output(); understood) {
    talk.line->send(said);
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

using MakeLine = std::unique_ptr<emulator::DeviceLine> (*)();
using MakeTalk = Talk (*)(std::unique_ptr<emulator::DeviceLine>);

/// A talk whose handshake is over. Nothing: it did not come to an end.
std::optional<Talk> connected(benchmark::State& state, MakeTalk make, MakeLine make_line) {
  std::unique_ptr<emulator::DeviceLine> line = make_line();
  if (const Status plugged = line->plug(); !plugged) {
    state.SkipWithError(plugged.error().message.c_str());
    return std::nullopt;
  }
  Talk talk = make(std::move(line));
  const Wall::time_point limit = Wall::now() + kHandshakeLimit;
  bool reads = false;
  for (const Status active = talk.driver->activate(); active && !reads && Wall::now() < limit;) {
    play(talk);
    reads = talk.newest().has_value();
  }
  if (!reads) {
    state.SkipWithError("the driver does not connect");
    return std::nullopt;
  }
  return talk;
}

/// Waits for the driver to count another packet. It can be read from then on, because both happen under one lock; a
/// look at the counter, unlike a read of the base, does not wake the driver.
bool await_packet(const Talk& talk, std::uint64_t before, Wall::time_point limit) {
  while (talk.driver->statistics()->packets_in == before) {
    if (Wall::now() > limit) {
      return false;
    }
    std::this_thread::sleep_for(kPollPause);
  }
  return true;
}

double milliseconds(Wall::duration time) { return std::chrono::duration<double, std::milli>(time).count(); }

void report(benchmark::State& state, const std::string& name, const std::vector<double>& delays_ms) {
  if (!delays_ms.empty()) {
    state.counters[name + "p50_ms"] = testing::quantile(delays_ms, 0.50);
    state.counters[name + "p99_ms"] = testing::quantile(delays_ms, 0.99);
  }
}

void delivery(benchmark::State& state, MakeTalk make, MakeLine make_line) {
  const log::ScopedSink quiet([](const log::Line&) {});
  std::optional<Talk> talk = connected(state, make, make_line);
  if (!talk) {
    return;
  }
  std::vector<double> delays_ms;
  Wall::time_point due = Wall::now();
  unsigned number = 0;
  for (auto _ : state) {
    due += kScanPeriod;
    std::this_thread::sleep_until(due);
    (void)talk->line->receive();
    (void)talk->newest();
    const std::uint64_t before = talk->driver->statistics()->packets_in;
    const Bytes packet = talk->packet(++number);
    const Wall::time_point sent = Wall::now();
    talk->line->send(packet);
    if (!await_packet(*talk, before, sent + kPacketLimit) || talk->newest() != number) {
      state.SkipWithError("a packet is missing");
      break;
    }
    const Wall::duration delay = Wall::now() - sent;
    delays_ms.push_back(milliseconds(delay));
    state.SetIterationTime(delays_ms.back() * 1e-3);
  }
  report(state, "", delays_ms);
}

/// Sends numbered packets with the device's period on a thread of its own, and knows when each left.
class Sender {
 public:
  explicit Sender(Talk& talk) : talk_(talk) {}

  [[nodiscard]] Wall::time_point sent_at(unsigned number) const {
    return Wall::time_point(Wall::duration(sent_.at(number).load()));
  }

 private:
  void run(const std::stop_token& stop) {
    Wall::time_point due = Wall::now();
    for (unsigned number = 1; !stop.stop_requested() && number < sent_.size(); ++number) {
      due += talk_.period;
      std::this_thread::sleep_until(due);
      (void)talk_.line->receive();
      const Bytes packet = talk_.packet(number);
      sent_[number] = Wall::now().time_since_epoch().count();
      talk_.line->send(packet);
    }
  }

  /// Twice what the faster device sends in all ticks.
  static constexpr std::size_t kMostSent = 2 * kTicks * (kTick / kScanPeriod + 1);

  Talk& talk_;
  std::array<std::atomic<Wall::rep>, kMostSent> sent_{};
  std::jthread thread_{[this](const std::stop_token& stop) { run(stop); }};
};

void tick(benchmark::State& state, MakeTalk make, MakeLine make_line) {
  const log::ScopedSink quiet([](const log::Line&) {});
  std::optional<Talk> talk = connected(state, make, make_line);
  if (!talk) {
    return;
  }
  std::vector<double> ages_ms;
  std::vector<double> reads_ms;
  (void)talk->newest();
  const Sender sender(*talk);
  for (auto _ : state) {
    const Status ticked = talk->host.clock->advance(kTick);
    while (!talk->host.clock->await(kTick).value_or(true)) {
    }
    const Wall::time_point begun = Wall::now();
    const std::optional<unsigned> number = talk->newest();
    const Wall::time_point read = Wall::now();
    if (!ticked || !number) {
      state.SetIterationTime(0.0);
      continue;
    }
    ages_ms.push_back(milliseconds(read - sender.sent_at(*number)));
    reads_ms.push_back(milliseconds(read - begun));
    state.SetIterationTime(ages_ms.back() * 1e-3);
  }
  report(state, "", ages_ms);
  report(state, "read_", reads_ms);
  state.counters["empty_ticks"] = static_cast<double>(kTicks) - static_cast<double>(ages_ms.size());
}

BENCHMARK_CAPTURE(delivery, base_terminal, base, terminal)->Iterations(kPackets)->UseManualTime();
BENCHMARK_CAPTURE(delivery, base_tcp, base, tcp)->Iterations(kPackets)->UseManualTime();
BENCHMARK_CAPTURE(delivery, lms200_terminal, lidar, terminal)->Iterations(kPackets)->UseManualTime();
BENCHMARK_CAPTURE(delivery, lms200_tcp, lidar, tcp)->Iterations(kPackets)->UseManualTime();
BENCHMARK_CAPTURE(tick, base_terminal, base, terminal)->Iterations(kTicks)->UseManualTime();
BENCHMARK_CAPTURE(tick, base_tcp, base, tcp)->Iterations(kTicks)->UseManualTime();
BENCHMARK_CAPTURE(tick, lms200_terminal, lidar, terminal)->Iterations(kTicks)->UseManualTime();
BENCHMARK_CAPTURE(tick, lms200_tcp, lidar, tcp)->Iterations(kTicks)->UseManualTime();

}  // namespace

int main(int argc, char** argv) {
  // Pauses of kPollPause are as short as they say.
  ::prctl(PR_SET_TIMERSLACK, 1000);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
