/// \file
/// Charts of figures and tables: axes, ticks, grid, legend.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/core/image.hpp"
#include "common/image/canvas.hpp"

namespace seeker::image {

enum class SeriesStyle : std::uint8_t { kLine, kPoints, kLineAndPoints, kBars };

/// Values that belong together. A point whose x or y is not finite breaks the line.
struct Series {
  std::string name;  ///< shown in the legend; empty: not shown
  std::vector<double> x;
  std::vector<double> y;  ///< as many as x
  SeriesStyle style = SeriesStyle::kLine;
  std::optional<Colour> colour = std::nullopt;  ///< else series_colour()
  LineStyle line = LineStyle::kSolid;
};

/// Lowest and highest value of an axis.
using AxisRange = std::pair<double, double>;

struct Chart {
  std::string title;
  std::string x_label;  ///< with its unit
  std::string y_label;
  std::vector<Series> series;
  std::optional<AxisRange> x_range;  ///< else what holds all values
  std::optional<AxisRange> y_range;
  std::vector<std::string> x_names;  ///< names of the bars at x = 0, 1, 2...; replaces the ticks of x
  bool equal_scale = false;          ///< one unit is as long in x as in y
};

/// Draws the chart; one without any finite value has empty axes.
[[nodiscard]] Image draw_chart(const Chart& chart, int width_px = 900, int height_px = 560);

/// Round tick values (1, 2 or 5 times a power of ten) that cover [low, high] in about `count` steps.
[[nodiscard]] std::vector<double> ticks(double low, double high, int count);

}  // namespace seeker::image
