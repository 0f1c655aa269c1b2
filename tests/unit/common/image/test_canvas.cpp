#include "common/image/canvas.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "common/core/rng.hpp"
#include "common/image/plot.hpp"

namespace seeker::image {
namespace {

int count_changed(const Canvas& canvas, Colour background) {
  int changed = 0;
  for (int v = 0; v < canvas.height_px(); ++v) {
    for (int u = 0; u < canvas.width_px(); ++u) {
      changed += canvas.pixel(u, v) == background ? 0 : 1;
    }
  }
  return changed;
}

int count_changed_in_row(const Canvas& canvas, int v) {
  int changed = 0;
  for (int u = 0; u < canvas.width_px(); ++u) {
    changed += canvas.pixel(u, v) == kWhite ? 0 : 1;
  }
  return changed;
}

TEST(Canvas, FilledRectangleCoversExactlyItsPixels) {
  Canvas canvas(20, 10, kWhite);
  canvas.fill_rect({3, 2, 5, 4}, kBlack);
  EXPECT_EQ(count_changed(canvas, kWhite), 20);
  EXPECT_EQ(canvas.pixel(3, 2), kBlack);
  EXPECT_EQ(canvas.pixel(7, 5), kBlack);
  EXPECT_EQ(canvas.pixel(8, 5), kWhite);
}

TEST(Canvas, HalfCoveredPixelsAreHalfBlended) {
  Canvas canvas(4, 4, kWhite);
  canvas.fill_rect({0.5, 0, 1, 4}, {0, 0, 0});
  EXPECT_NEAR(canvas.pixel(0, 1).red, 128, 2);
  EXPECT_NEAR(canvas.pixel(1, 1).red, 128, 2);
  EXPECT_EQ(canvas.pixel(2, 1), kWhite);
}

TEST(Canvas, TranslucentLineIsEvenWhereItsPiecesMeet) {
  Canvas canvas(30, 30, kWhite);
  const std::array<Point2, 3> corner{Point2(5, 15), Point2(15, 15), Point2(25, 15)};
  canvas.polyline(corner, {{0, 0, 0}, 4.0, LineStyle::kSolid, 0.5});
  EXPECT_EQ(canvas.pixel(15, 15), canvas.pixel(9, 15));
  EXPECT_NEAR(canvas.pixel(15, 15).red, 128, 2);
}

TEST(Canvas, DashedLineHasGapsAndASolidOneHasNone) {
  Canvas solid(100, 5, kWhite);
  Canvas dashed(100, 5, kWhite);
  solid.line(Point2(0, 2.5), Point2(100, 2.5), {kBlack, 1.0, LineStyle::kSolid});
  dashed.line(Point2(0, 2.5), Point2(100, 2.5), {kBlack, 1.0, LineStyle::kDashed});
  const int full = count_changed(solid, kWhite);
  EXPECT_EQ(solid.pixel(50, 2), kBlack);
  EXPECT_LT(count_changed(dashed, kWhite), full);
  EXPECT_GT(count_changed(dashed, kWhite), full / 4);
}

TEST(Canvas, EllipseOfACovarianceHasItsRadii) {
  Canvas canvas(100, 100, kWhite);
  Matrix2 covariance;
  covariance << 100.0, 0.0, 0.0, 25.0;
  canvas.ellipse(Point2(50.5, 50.5), covariance, 2.0, {kRed, 2.0});
  EXPECT_EQ(canvas.pixel(70, 50), kRed);
  EXPECT_EQ(canvas.pixel(50, 60), kRed);
  EXPECT_EQ(canvas.pixel(50, 50), kWhite);
  EXPECT_EQ(canvas.pixel(50, 70), kWhite);
}

TEST(Canvas, ArrowHeadIsAtItsEnd) {
  Canvas canvas(60, 20, kWhite);
  canvas.arrow(Point2(5, 10), Point2(55, 10), {kBlue, 2.0}, 12.0);
  EXPECT_EQ(canvas.pixel(44, 13), kBlue);
  EXPECT_EQ(canvas.pixel(20, 13), kWhite);
}

RC_GTEST_PROP(Canvas, NothingDrawnAnywhereLeavesTheImageOrCrashes, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint64_t>());
  Canvas canvas(37, 23, kWhite);
  const auto wild = [&rng] {
    const std::array<double, 5> scales{10.0, 100.0, 1e4, 1e9, std::numeric_limits<double>::infinity()};
    return scales.at(rng.below(scales.size())) * rng.uniform(-1.0, 1.0);
  };
  for (int n = 0; n < 20; ++n) {
    const std::array<Point2, 3> points{Point2(wild(), wild()), Point2(wild(), wild()), Point2(wild(), wild())};
    canvas.polyline(points, {kRed, rng.uniform(0.0, 9.0), static_cast<LineStyle>(rng.below(4)), rng.uniform()});
    canvas.fill_polygon(points, kGreen, rng.uniform());
    canvas.circle(points[0], std::abs(points[1].x()), {kBlue, 1.0});
    canvas.text(points[0], "x", {kBlack, 9.0});
  }
  RC_ASSERT(canvas.image().data().size() == 37U * 23U * 3U);
}

TEST(Canvas, EveryPrintableCharacterIsDrawnAndLooksLikeNoOther) {
  std::map<std::vector<std::uint8_t>, char> drawn;
  for (char c = '!'; c <= '~'; ++c) {
    Canvas canvas(40, 40, kWhite);
    canvas.text(Point2(8, 28), std::string(1, c), {{0, 0, 0}, 18.0});
    EXPECT_GT(count_changed(canvas, kWhite), 0) << c;
    const auto [former, is_new] = drawn.emplace(canvas.image().data(), c);
    EXPECT_TRUE(is_new) << c << " and " << former->second;
  }
}

TEST(Canvas, SignsOutsideAsciiAreDrawnAndBytesThatAreNoTextAreSkipped) {
  const double metres = text_width_px("5 m", 14.0);
  EXPECT_GT(text_width_px("5 m\xC2\xB2", 14.0), metres + 3.0);
  for (const char* damaged : {"5 m\xC2",
                              "\x80\x80"
                              "5 m",
                              "5\xED\xA0\x80 m", "5 \xC0\x80m", "5 m\xF5\x80\x80\x80"}) {
    EXPECT_DOUBLE_EQ(text_width_px(damaged, 14.0), metres) << damaged;
  }
  Canvas canvas(60, 20, kWhite);
  canvas.text(Point2(2, 18), "\xFF", {kBlack, 14.0});
  EXPECT_EQ(count_changed(canvas, kWhite), 0);
  canvas.text(Point2(2, 18), "5 m", {kBlack, 14.0});
  EXPECT_GT(count_changed(canvas, kWhite), 0);
}

TEST(Canvas, TextIsAsWideAsPromisedAndStandsOnItsLine) {
  Canvas canvas(200, 40, kWhite);
  canvas.text(Point2(10, 30), "HH", {{0, 0, 0}, 14.0});
  const double width = text_width_px("HH", 14.0);
  EXPECT_NEAR(text_width_px("HH", 28.0), 2.0 * width, 1e-2);
  const auto is_dark = [&](int u, int v) { return canvas.pixel(u, v).red < 60; };
  int first = 200;
  int last = 0;
  for (int u = 0; u < 200; ++u) {
    if (is_dark(u, 25)) {
      first = std::min(first, u);
      last = u;
    }
  }
  constexpr double kBearing_px = 3.0;  // of a letter, at either side
  EXPECT_NEAR(first, 10.0 + kBearing_px / 2.0, kBearing_px / 2.0);
  EXPECT_NEAR(last, 10.0 + width - kBearing_px / 2.0, kBearing_px / 2.0 + 1.0);
  EXPECT_TRUE(is_dark(first, 29)) << "foot of the first stem";
  EXPECT_TRUE(is_dark(first, 17)) << "its top";
  EXPECT_EQ(count_changed_in_row(canvas, 31), 0);
  EXPECT_EQ(count_changed_in_row(canvas, 14), 0);
}

TEST(Canvas, AWindowClipsAndHasItsOwnOrigin) {
  Canvas canvas(20, 20, kWhite);
  Canvas window = canvas.window({5, 6, 10, 4});
  EXPECT_EQ(window.width_px(), 10);
  EXPECT_EQ(window.height_px(), 4);
  window.fill_rect({-3, 1, 30, 30}, kRed);
  EXPECT_EQ(count_changed(canvas, kWhite), 10 * 3);
  EXPECT_EQ(canvas.pixel(5, 7), kRed);
  EXPECT_EQ(canvas.pixel(14, 9), kRed);
}

TEST(Canvas, APictureLiesOnWholePixelsWithItsExactColours) {
  Canvas canvas(8, 8, kWhite);
  const auto colour_at = [](int u, int v) {
    return u == v ? std::optional<Colour>(Colour{static_cast<std::uint8_t>(17 * u + 3), 130, 77}) : std::nullopt;
  };
  canvas.picture(2, 1, 4, 4, colour_at);
  EXPECT_EQ(count_changed(canvas, kWhite), 4);
  EXPECT_EQ(canvas.pixel(2, 1), (Colour{3, 130, 77}));
  EXPECT_EQ(canvas.pixel(5, 4), (Colour{54, 130, 77}));
  EXPECT_EQ(Canvas(canvas.image()).image(), canvas.image());
}

TEST(Canvas, ShapesAreWrittenAsADrawing) {
  Canvas canvas = Canvas::vector(100, 50, kWhite);
  canvas.text(Point2(1, 20), "a<b & \"c\"", {});
  canvas.line(Point2(0, 0), Point2(10, std::nan("")), {kRed, 2.0, LineStyle::kDashed});
  canvas.fill_circle(Point2(5, 5), 2.5, kBlue, 0.5);
  const std::string text = canvas.svg();
  EXPECT_NE(text.find("<svg"), std::string::npos);
  EXPECT_NE(text.find("fill-opacity:0.5"), std::string::npos);
  EXPECT_NE(text.find("stroke-dasharray:8,7"), std::string::npos);
  EXPECT_NE(text.find("</svg>"), std::string::npos);
  EXPECT_EQ(text.find("nan"), std::string::npos);
  EXPECT_EQ(text.find("<image"), std::string::npos);
}

TEST(Colour, MapsRunFromEndToEndAndRefuseNothing) {
  EXPECT_EQ(viridis(0.0), (Colour{68, 1, 84}));
  EXPECT_EQ(viridis(1.0), (Colour{253, 231, 37}));
  EXPECT_EQ(viridis(7.0), viridis(1.0));
  EXPECT_EQ(viridis(std::nan("")), viridis(0.0));
  EXPECT_EQ(series_colour(6), series_colour(0));
}

TEST(Plot, TicksAreRoundAndInsideTheRange) {
  EXPECT_EQ(ticks(0.0, 10.0, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  EXPECT_TRUE(ticks(1.0, 1.0, 5).empty());
  EXPECT_TRUE(ticks(std::nan(""), 1.0, 5).empty());
  for (const double value : ticks(-3.7, 12.2, 6)) {
    EXPECT_GE(value, -3.7);
    EXPECT_LE(value, 12.2);
  }
}

TEST(Plot, CurveRunsThroughItsPointsInItsColour) {
  Chart chart;
  chart.title = "a line";
  chart.series = {{"flat", {0, 1, 2}, {5, 5, 5}, SeriesStyle::kLine, kRed}};
  chart.y_range = AxisRange{0.0, 10.0};
  const Canvas picture(draw_chart(chart, 400, 300));
  int red = 0;
  for (int u = 0; u < 400; ++u) {
    red += picture.pixel(u, 141) == kRed ? 1 : 0;  // middle of the area between the axes: 48 + (300 - 48 - 66) / 2
  }
  EXPECT_GT(red, 200);
}

TEST(Plot, ValuesThatAreNoNumbersBreakTheLineOnly) {
  Chart chart;
  chart.series = {{"broken", {0, 1, std::nan(""), 3}, {1, 2, 3, std::nan("")}, SeriesStyle::kLineAndPoints}};
  EXPECT_EQ(draw_chart(chart, 300, 200).width_px(), 300);
  EXPECT_EQ(draw_chart({}, 300, 200).height_px(), 200);
}

}  // namespace
}  // namespace seeker::image
