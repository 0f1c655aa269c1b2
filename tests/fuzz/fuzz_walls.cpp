/// \file
/// Any text through the readers of walls, and what they accept on to points.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "common/core/assert.hpp"
#include "server/lab/scoring/score_walls.hpp"

// NOLINTNEXTLINE: the name is libFuzzer's
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr double kStep_m = 5.0;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto check = [](const seeker::lab::Walls& walls) {
    for (const seeker::Point2& point : seeker::lab::sample_walls(walls, kStep_m)) {
      SEEKER_ASSERT(point.allFinite());
    }
  };
  check(seeker::lab::parse_csv_walls(text));
  if (const auto walls = seeker::lab::parse_geojson_walls(text)) {
    check(*walls);
  }
  return 0;
}
