/// \file
/// Any bytes as a mission script: a script or a typed error that names the file.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "client/cli/script.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto script = seeker::cli::parse_script(text, "fuzz.yaml");
  if (script ? script->steps.empty() : !script.error().message.starts_with("fuzz.yaml")) {
    std::abort();
  }
  return 0;
}
