#include "server/drivers/hardware/device_faults.hpp"

#include <utility>

namespace seeker::drivers {

DeviceFault fault_of(std::string id, const Error& error, bool blocking) {
  auto [cause, remedy] = cause_and_remedy(error);
  return {std::move(id), std::move(cause), remedy.empty() ? "see what the device shows" : std::move(remedy), blocking};
}

std::vector<DeviceFault> faults_of(const Status& state, const std::optional<Error>& warning) {
  std::vector<DeviceFault> faults;
  if (!state) {
    // A device that has not answered yet is no lost one.
    faults.push_back(fault_of(state.error().code == Errc::kNotReady ? "starting" : "lost", state.error(), true));
  }
  if (warning) {
    faults.push_back(fault_of("warning", *warning, false));
  }
  return faults;
}

}  // namespace seeker::drivers
