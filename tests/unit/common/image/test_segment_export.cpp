#include "common/image/segment_export.hpp"

#include <gtest/gtest.h>

#include "tests/support/maps/random_map.hpp"

namespace seeker::image {
namespace {

std::size_t count(const std::string& text, const std::string& piece) {
  std::size_t n = 0;
  for (std::size_t at = text.find(piece); at != std::string::npos; at = text.find(piece, at + 1)) {
    ++n;
  }
  return n;
}

TEST(SegmentExport, GeoJsonHoldsEveryWallInMetresWithItsEnds) {
  const std::vector<MapSegment> room = testing::room_map(8.0, 5.0).segments;
  const std::string text = segments_geojson(room);
  EXPECT_EQ(count(text, "\"LineString\""), room.size());
  // The wall at x = 4 runs along -y as seen from inside: its left end is at y = 2.5.
  EXPECT_NE(text.find("\"coordinates\":[[4.0000,2.5000],[4.0000,-2.5000]]"), std::string::npos) << text;
  EXPECT_NE(text.find("\"length_m\":5.0000,\"hits\":10,\"sigma_m\":0.01000,\"sigma_rad\":0.002000"), std::string::npos);
  EXPECT_NE(segments_geojson({}).find("\"features\":["), std::string::npos);
}

TEST(SegmentExport, SvgShowsWallsRealAndOpenEndsAndAScale) {
  LineMap map = testing::room_map(8.0, 5.0);
  map.segments.front().left_real = false;
  const Result<std::string> svg = segments_svg({"room <1>", map.segments, {{0, 0, 0}, {1, 1, 0}}});
  ASSERT_TRUE(svg);
  EXPECT_EQ(count(*svg, "stroke-width:2;"), 4U) << "walls";
  EXPECT_EQ(count(*svg, "stroke-dasharray:6,5.25"), 1U) << "the way";
  EXPECT_EQ(count(*svg, "stroke-width:3;"), 1U) << "the scale bar";
  EXPECT_EQ(count(*svg, "stroke-width:1;"), 8U) << "ends";
  EXPECT_EQ(count(*svg, "<path style=\" stroke:none;fill-rule:evenodd;fill:rgb(100%,100%,100%)"), 1U) << "one open end";
  constexpr const char* kLetters = "stroke:none;fill-rule:nonzero";
  EXPECT_EQ(count(*svg, kLetters), 2U) << "the title and the length of the scale";
  EXPECT_EQ(count(*segments_svg({"", map.segments, {}}), kLetters), 1U);
}

TEST(SegmentExport, NothingToDrawIsAnError) {
  const Result<std::string> svg = segments_svg({});
  ASSERT_FALSE(svg);
  EXPECT_EQ(svg.error().code, Errc::kNotReady);
}

}  // namespace
}  // namespace seeker::image
