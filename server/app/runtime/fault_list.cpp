#include "server/app/runtime/fault_list.hpp"

#include <algorithm>

namespace seeker::app {

bool FaultList::raise(api::Fault fault) {
  const auto same = std::find_if(faults_.begin(), faults_.end(), [&](const api::Fault& f) { return f.id == fault.id; });
  if (same == faults_.end()) {
    faults_.push_back(std::move(fault));
    return true;
  }
  same->message = std::move(fault.message);
  same->remedy = std::move(fault.remedy);
  same->severity = fault.severity;
  return false;
}

bool FaultList::clear(const std::string& id) {
  return std::erase_if(faults_, [&](const api::Fault& f) { return f.id == id; }) > 0;
}

std::optional<api::Fault> FaultList::find(const std::string& id) const {
  const auto found = std::find_if(faults_.begin(), faults_.end(), [&](const api::Fault& f) { return f.id == id; });
  return found == faults_.end() ? std::nullopt : std::optional(*found);
}

const api::Fault* FaultList::blocking() const {
  const auto found = std::find_if(faults_.begin(), faults_.end(),
                                  [](const api::Fault& f) { return f.severity >= api::Severity::kError; });
  return found == faults_.end() ? nullptr : &*found;
}

}  // namespace seeker::app
