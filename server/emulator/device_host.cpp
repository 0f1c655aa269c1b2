#include "server/emulator/device_host.hpp"

#include <algorithm>
#include <utility>

#include "common/log/log.hpp"

namespace seeker::emulator {
namespace {

constexpr const char* kDevices = "devices";
constexpr const char* kLineFaults = "bit-errors RATE, lost-bytes RATE, silence, wrong-baud, unplug, power-cut";

bool is_line_fault(const std::string& fault) {
  return fault == "bit-errors" || fault == "lost-bytes" || fault == "silence" || fault == "wrong-baud" ||
         fault == "unplug" || fault == "power-cut";
}

}  // namespace

DeviceHost::DeviceHost(std::vector<HostedDevice> devices, std::uint64_t seed) {
  Rng rng(seed);
  devices_.reserve(devices.size());
  for (HostedDevice& parts : devices) {
    const std::string name = parts.name;
    devices_.push_back({std::move(parts),
                        LineNoise(rng.fork(name + "-in")),
                        LineNoise(rng.fork(name + "-out")),
                        LineFaults{},
                        {},
                        0.0,
                        false});
  }
}

Status DeviceHost::plug() {
  for (Hosted& hosted : devices_) {
    if (Status plugged = hosted.parts.line->plug(); !plugged) {
      return fail_with_context("device " + hosted.parts.name, plugged.error());
    }
    hosted.plugged = true;
  }
  return {};
}

DeviceHost::Hosted* DeviceHost::find(const std::string& name) {
  const auto found =
      std::find_if(devices_.begin(), devices_.end(), [&](const Hosted& hosted) { return hosted.parts.name == name; });
  return found == devices_.end() ? nullptr : &*found;
}

Status DeviceHost::add(FaultCommand command) {
  Hosted* hosted = find(command.device);
  if (hosted == nullptr) {
    std::string names;
    for (const Hosted& there : devices_) {
      names += (names.empty() ? "" : ", ") + there.parts.name;
    }
    return fail(Errc::kNotFound, "there is no device '" + command.device + "'; there are: " + names);
  }
  if (!is_line_fault(command.fault)) {
    // Off is what it is: this asks whether the device knows the fault.
    if (const Status known = hosted->parts.inject(command.fault, false); !known) {
      return fail(Errc::kNotFound, known.error().message + ", and of every line: " + kLineFaults);
    }
  }
  if (command.duration > Duration::zero()) {
    switches_.push_back({command.at + command.duration, command, false});
  }
  const RobotTime at = command.at;
  switches_.push_back({at, std::move(command), true});
  return {};
}

void DeviceHost::apply_due(RobotTime now) {
  std::stable_sort(switches_.begin(), switches_.end(), [](const Switch& a, const Switch& b) { return a.at < b.at; });
  while (!switches_.empty() && switches_.front().at <= now) {
    const Switch due = std::move(switches_.front());
    switches_.erase(switches_.begin());
    log::info(kDevices, due.command.device + ": " + due.command.fault + (due.on ? "" : " ends"));
    if (const Status applied = apply(*find(due.command.device), due.command, due.on, now); !applied) {
      log::error(kDevices, applied.error().message);
    }
  }
}

Status DeviceHost::apply(Hosted& hosted, const FaultCommand& command, bool on, RobotTime now) {
  const std::string& fault = command.fault;
  if (fault == "bit-errors") {
    hosted.faults.bit_error_rate = on ? command.value : 0.0;
  } else if (fault == "lost-bytes") {
    hosted.faults.lost_byte_rate = on ? command.value : 0.0;
  } else if (fault == "silence") {
    hosted.faults.silent = on;
  } else if (fault == "wrong-baud") {
    hosted.faults.wrong_baud = on;
  } else if (fault == "unplug" || fault == "power-cut") {
    hosted.sent.clear();
    if (on && fault == "power-cut") {
      hosted.parts.device->power_cycle(now);
    }
    if (on) {
      hosted.parts.line->unplug();
      hosted.plugged = false;
      return {};
    }
    hosted.plugged = true;
    return hosted.parts.line->plug();
  } else {
    return hosted.parts.inject(fault, on);
  }
  return {};
}

void DeviceHost::carry(Hosted& hosted, Duration period, RobotTime now) {
  constexpr double kBitsPerByte = 10.0;  // start bit, eight data bits, stop bit
  constexpr std::size_t kLongestQueue = 65536;
  EmulatedDevice& device = *hosted.parts.device;
  DeviceLine& line = *hosted.parts.line;
  LineFaults faults = hosted.faults;
  const std::uint32_t baud = device.baud();
  const std::uint32_t host_baud = line.host_baud();
  faults.wrong_baud = faults.wrong_baud || (baud != 0 && host_baud != 0 && baud != host_baud);
  if (hosted.plugged) {
    if (const std::vector<std::uint8_t> heard = hosted.to_device.carry(line.receive(), faults); !heard.empty()) {
      device.receive(heard, now);
    }
  }
  device.pass(now);
  const std::vector<std::uint8_t> out = device.take_output();
  hosted.sent.insert(hosted.sent.end(), out.begin(), out.end());
  hosted.sent.resize(std::min(hosted.sent.size(), kLongestQueue));
  std::size_t fits = hosted.sent.size();
  if (baud != 0) {
    const double most = to_seconds(period) * baud / kBitsPerByte;
    hosted.credit_bytes = std::min(hosted.credit_bytes + most, 2.0 * most);
    fits = std::min(fits, static_cast<std::size_t>(hosted.credit_bytes));
    hosted.credit_bytes -= static_cast<double>(fits);
  }
  const auto end = hosted.sent.begin() + static_cast<std::ptrdiff_t>(fits);
  const std::vector<std::uint8_t> carried(hosted.sent.begin(), end);
  hosted.sent.erase(hosted.sent.begin(), end);
  if (hosted.plugged) {
    line.send(hosted.to_host.carry(carried, faults));
  }
}

void DeviceHost::step(RobotTime now) {
  apply_due(now);
  for (Hosted& hosted : devices_) {
    carry(hosted, now - now_, now);
  }
  now_ = now;
}

std::string DeviceHost::addresses() const {
  std::string text;
  for (const Hosted& hosted : devices_) {
    text += hosted.parts.name + " " + hosted.parts.line->address() + "\n";
  }
  return text;
}

}  // namespace seeker::emulator
