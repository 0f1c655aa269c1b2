#include "common/image/plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

namespace seeker::image {
namespace {

constexpr double kLeft_px = 84.0;
constexpr double kRight_px = 24.0;
constexpr double kTop_px = 48.0;
constexpr double kBottom_px = 66.0;
constexpr double kTickText_px = 9.5;
constexpr double kLabelText_px = 10.5;
constexpr double kTitleText_px = 13.0;
constexpr int kTickCount_x = 8;
constexpr int kTickCount_y = 6;
constexpr double kBarGroupShare = 0.8;

/// The part of the picture between the axes.
struct Frame {
  Rect area;
  AxisRange x;
  AxisRange y;

  [[nodiscard]] Point2 to_px(double x_value, double y_value) const {
    return {area.x_px + (x_value - x.first) / (x.second - x.first) * area.width_px,
            area.y_px + (y.second - y_value) / (y.second - y.first) * area.height_px};
  }
};

bool has_bars(const Chart& chart) {
  return std::any_of(chart.series.begin(), chart.series.end(),
                     [](const Series& s) { return s.style == SeriesStyle::kBars; });
}

AxisRange range_of(const Chart& chart, std::vector<double> Series::*values) {
  AxisRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Series& series : chart.series) {
    for (const double value : series.*values) {
      if (std::isfinite(value)) {
        range = {std::min(range.first, value), std::max(range.second, value)};
      }
    }
  }
  if (range.first > range.second) {
    return {0.0, 1.0};
  }
  if (range.first == range.second) {
    return {range.first - 0.5, range.second + 0.5};
  }
  return range;
}

AxisRange with_margin(AxisRange range, double share) {
  const double margin = share * (range.second - range.first);
  return {range.first - margin, range.second + margin};
}

/// Stretches one axis so that a unit has the same length on both.
void make_equal(Frame& frame) {
  const double x_m_per_px = (frame.x.second - frame.x.first) / frame.area.width_px;
  const double y_m_per_px = (frame.y.second - frame.y.first) / frame.area.height_px;
  if (x_m_per_px < y_m_per_px) {
    frame.x = with_margin(frame.x, (y_m_per_px / x_m_per_px - 1.0) / 2.0);
  } else {
    frame.y = with_margin(frame.y, (x_m_per_px / y_m_per_px - 1.0) / 2.0);
  }
}

Frame frame_of(const Chart& chart, int width_px, int height_px) {
  Frame frame;
  frame.area = {kLeft_px, kTop_px, std::max(10.0, width_px - kLeft_px - kRight_px),
                std::max(10.0, height_px - kTop_px - kBottom_px)};
  constexpr double kMargin = 0.04;
  AxisRange y = range_of(chart, &Series::y);
  if (has_bars(chart)) {
    y = {std::min(0.0, y.first), std::max(0.0, y.second)};
    y.second += kMargin * (y.second - y.first);
    const AxisRange x = range_of(chart, &Series::x);
    const double last = std::max(x.second, static_cast<double>(chart.x_names.size()) - 1.0);
    frame.x = chart.x_range.value_or(AxisRange{std::floor(x.first) - 0.5, last + 0.5});
  } else {
    y = with_margin(y, kMargin);
    frame.x = chart.x_range.value_or(with_margin(range_of(chart, &Series::x), kMargin / 2.0));
  }
  frame.y = chart.y_range.value_or(y);
  if (!(frame.x.second > frame.x.first) || !(frame.y.second > frame.y.first)) {
    frame.x = {0.0, 1.0};
    frame.y = {0.0, 1.0};
  }
  if (chart.equal_scale) {
    make_equal(frame);
  }
  return frame;
}

std::string tick_text(double value, double step) {
  std::array<char, 32> text{};
  if (std::abs(value) < step * 1e-6) {
    return "0";
  }
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

void draw_x_axis(Canvas& canvas, const Frame& frame, const Chart& chart) {
  const double bottom = frame.area.y_px + frame.area.height_px;
  const TextStyle style{kBlack, kTickText_px, Anchor::kCentre};
  if (!chart.x_names.empty()) {
    for (std::size_t i = 0; i < chart.x_names.size(); ++i) {
      const double x = frame.to_px(static_cast<double>(i), 0.0).x();
      canvas.text(Point2(x, bottom + 20.0), chart.x_names[i], style);
    }
  } else {
    const std::vector<double> values = ticks(frame.x.first, frame.x.second, kTickCount_x);
    for (const double value : values) {
      const double x = frame.to_px(value, 0.0).x();
      canvas.line(Point2(x, frame.area.y_px), Point2(x, bottom), {kLightGrey, 1.0});
      canvas.line(Point2(x, bottom), Point2(x, bottom + 5.0), {kGrey, 1.2});
      canvas.text(Point2(x, bottom + 20.0), tick_text(value, frame.x.second - frame.x.first), style);
    }
  }
  canvas.text(Point2(frame.area.x_px + frame.area.width_px / 2.0, bottom + 46.0), chart.x_label,
              {kBlack, kLabelText_px, Anchor::kCentre});
}

void draw_y_axis(Canvas& canvas, const Frame& frame, const Chart& chart) {
  const double left = frame.area.x_px;
  for (const double value : ticks(frame.y.first, frame.y.second, kTickCount_y)) {
    const double y = frame.to_px(0.0, value).y();
    canvas.line(Point2(left, y), Point2(left + frame.area.width_px, y), {kLightGrey, 1.0});
    canvas.line(Point2(left - 5.0, y), Point2(left, y), {kGrey, 1.2});
    canvas.text(Point2(left - 9.0, y + kTickText_px / 2.0), tick_text(value, frame.y.second - frame.y.first),
                {kBlack, kTickText_px, Anchor::kRight});
  }
  canvas.text(Point2(24.0, frame.area.y_px + frame.area.height_px / 2.0), chart.y_label,
              {kBlack, kLabelText_px, Anchor::kCentre, true});
}

void draw_bars(Canvas& canvas, const Frame& frame, const Series& series, Colour colour, std::size_t bar_index,
               std::size_t bar_count) {
  const double width = kBarGroupShare / static_cast<double>(bar_count);
  for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i) {
    const double left = series.x[i] - kBarGroupShare / 2.0 + width * static_cast<double>(bar_index);
    const Point2 a = frame.to_px(left, series.y[i]);
    const Point2 b = frame.to_px(left + width, 0.0);
    canvas.fill_rect({a.x() + 1.0, std::min(a.y(), b.y()), b.x() - a.x() - 2.0, std::abs(b.y() - a.y())}, colour);
  }
}

void draw_curve(Canvas& canvas, const Frame& frame, const Series& series, Colour colour) {
  std::vector<Point2> run;
  const auto flush = [&] {
    if (series.style != SeriesStyle::kPoints && run.size() > 1) {
      canvas.polyline(run, {colour, 2.2, series.line});
    }
    if (series.style != SeriesStyle::kLine || run.size() == 1) {
      for (const Point2& p : run) {
        canvas.fill_circle(p, 3.4, colour);
      }
    }
    run.clear();
  };
  for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i) {
    const Point2 p = frame.to_px(series.x[i], series.y[i]);
    if (p.allFinite()) {
      run.push_back(p);
    } else {
      flush();
    }
  }
  flush();
}

void draw_series(Canvas& canvas, const Frame& frame, const Chart& chart) {
  const auto bar_count = static_cast<std::size_t>(std::count_if(
      chart.series.begin(), chart.series.end(), [](const Series& s) { return s.style == SeriesStyle::kBars; }));
  std::size_t bar_index = 0;
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    const Series& series = chart.series[i];
    const Colour colour = series.colour.value_or(series_colour(i));
    if (series.style == SeriesStyle::kBars) {
      draw_bars(canvas, frame, series, colour, bar_index++, bar_count);
    } else {
      draw_curve(canvas, frame, series, colour);
    }
  }
}

void draw_sample(Canvas& canvas, const Point2& middle, const Series& series, Colour colour) {
  if (series.style == SeriesStyle::kBars) {
    canvas.fill_rect({middle.x() - 10.0, middle.y() - 6.0, 20.0, 12.0}, colour);
  } else if (series.style == SeriesStyle::kPoints) {
    canvas.fill_circle(middle, 3.4, colour);
  } else {
    canvas.line(middle - Point2(12.0, 0.0), middle + Point2(12.0, 0.0), {colour, 2.2, series.line});
  }
}

void draw_legend(Canvas& canvas, const Frame& frame, const Chart& chart) {
  double widest = 0.0;
  double count = 0.0;
  for (const Series& series : chart.series) {
    widest = std::max(widest, text_width_px(series.name, kTickText_px));
    count += series.name.empty() ? 0.0 : 1.0;
  }
  if (count == 0.0) {
    return;
  }
  constexpr double kRow_px = 19.0;
  const double left = frame.area.x_px + frame.area.width_px - widest - 60.0;
  double y = frame.area.y_px + 10.0;
  canvas.fill_rect({left, y, widest + 50.0, count * kRow_px + 8.0}, kWhite, 0.86);
  canvas.rect({left, y, widest + 50.0, count * kRow_px + 8.0}, {kLightGrey, 1.0});
  y += 4.0;
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    const Series& series = chart.series[i];
    if (series.name.empty()) {
      continue;
    }
    const Point2 middle(left + 20.0, y + kRow_px / 2.0);
    draw_sample(canvas, middle, series, series.colour.value_or(series_colour(i)));
    canvas.text(Point2(left + 40.0, middle.y() + kTickText_px / 2.0), series.name, {kBlack, kTickText_px});
    y += kRow_px;
  }
}

}  // namespace

std::vector<double> ticks(double low, double high, int count) {
  if (!std::isfinite(low) || !std::isfinite(high) || !(high > low) || count < 1) {
    return {};
  }
  const double rough = (high - low) / count;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10.0 * power;
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough * 0.999) {
      step = factor * power;
      break;
    }
  }
  std::vector<double> values;
  const double tolerance = 1e-9 * step;
  const double first = std::ceil((low - tolerance) / step);
  for (double n = first; n * step <= high + tolerance && values.size() <= 4U * static_cast<std::size_t>(count); ++n) {
    values.push_back(n * step);
  }
  return values;
}

Image draw_chart(const Chart& chart, int width_px, int height_px) {
  const Frame frame = frame_of(chart, width_px, height_px);
  Canvas canvas(width_px, height_px, kWhite);
  draw_x_axis(canvas, frame, chart);
  draw_y_axis(canvas, frame, chart);
  // A given range cuts off what lies beyond the axes.
  Canvas inside = canvas.window(frame.area);
  Frame inner = frame;
  inner.area.x_px = inner.area.y_px = 0.0;
  draw_series(inside, inner, chart);
  const Rect& area = frame.area;
  canvas.rect(area, {kGrey, 1.2});
  canvas.text(Point2(area.x_px + area.width_px / 2.0, kTop_px - 18.0), chart.title,
              {kBlack, kTitleText_px, Anchor::kCentre});
  draw_legend(canvas, frame, chart);
  return canvas.image();
}

}  // namespace seeker::image
