/// \file
/// A serial port for programs that expect a real one.
#pragma once

#include <filesystem>

#include "server/emulator/device_line.hpp"

namespace seeker::emulator {

/// A pseudo-terminal that is found by a symbolic link, because the system chooses its name.
class PseudoTerminal final : public DeviceLine {
 public:
  explicit PseudoTerminal(std::filesystem::path link) : link_(std::move(link)) {}
  ~PseudoTerminal() override { unplug(); }

  [[nodiscard]] Status plug() override;
  void unplug() override;
  [[nodiscard]] std::vector<std::uint8_t> receive() override;
  void send(std::span<const std::uint8_t> bytes) override;
  [[nodiscard]] std::uint32_t host_baud() const override;
  [[nodiscard]] std::string address() const override { return link_.string(); }

 private:
  std::filesystem::path link_;
  int master_ = -1;
  int slave_ = -1;  ///< kept open, so that the line does not end when a host closes it
};

}  // namespace seeker::emulator
