// Robot files from anywhere: text in, options or an error out, never a crash; no file is opened.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "common/core/assert.hpp"
#include "server/app/composition/robot_options.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto options = seeker::app::parse_robot_options(text, "fuzz.yaml");
  if (!options) {
    SEEKER_ASSERT(!options.error().message.empty());
  } else {
    SEEKER_ASSERT(options->loop.period > seeker::Duration::zero());
  }
  // What a client sets while the robot runs is a text in the place of one value.
  (void)seeker::app::parse_robot_options("", "fuzz.yaml", {"loop.safety.max_v_m_s=" + std::string(text)});
  return 0;
}
