// World files from anywhere: text in, a valid world or an error out, never a crash; no file is opened.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "common/core/assert.hpp"
#include "server/options/world_options.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using seeker::options::TargetDescription;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto file = seeker::options::parse_world(text, "fuzz.yaml");
  if (!file) {
    SEEKER_ASSERT(!file.error().message.empty());
    return 0;
  }
  const auto world = seeker::options::build_world(*file, [](const std::string& name) {
    TargetDescription target;
    target.file.name = name;
    target.picture = seeker::Image(4, 8, 1);
    return seeker::Result<TargetDescription>(target);
  });
  if (world) {
    SEEKER_ASSERT(seeker::sim::validate(*world).has_value());
  }
  return 0;
}
