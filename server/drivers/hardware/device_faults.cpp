#include "server/drivers/hardware/device_faults.hpp"

#include <utility>

namespace seeker::drivers {

DeviceFault fault_of(std::string id, const Error& error, bool blocking) {
  const std::size_t last = error.message.rfind("; ");
  constexpr std::size_t kSeparator = 2;
  return last == std::string::npos ? DeviceFault{std::move(id), error.message, "see what the device shows", blocking}
                                   : DeviceFault{std::move(id), error.message.substr(0, last),
                                                 error.message.substr(last + kSeparator), blocking};
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
