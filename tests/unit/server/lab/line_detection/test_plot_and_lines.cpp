#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include <gtest/gtest.h>

#include "common/image/colour.hpp"
#include "common/image/png.hpp"
#include "server/lab/experiments/log_stopwatch.hpp"
#include "server/lab/line_detection/lines_command.hpp"
#include "server/lab/slam/plot_trajectories.hpp"
#include "tests/support/data.hpp"
#include "tests/unit/server/lab/experiments/files.hpp"

namespace seeker::lab {
namespace {

class PlotAndLines : public LabFiles {};

/// Three scans of 181 beams in a room whose wall is 2 m ahead; the second is cut.
std::string room_log() {
  std::string ranges;
  for (int k = 0; k <= 180; ++k) {
    const double angle_rad = (k - 90) * 3.14159265358979 / 180.0;
    const double ahead_m = 2.0 / std::max(std::cos(angle_rad), 1e-9);
    const double aside_m = 1.5 / std::max(std::abs(std::sin(angle_rad)), 1e-9);
    ranges += " " + std::to_string(std::min(ahead_m, aside_m));
  }
  const auto scan = [&](double x_m, double stamp_s) {
    const std::string pose = " " + std::to_string(x_m) + " 0 0";
    return "FLASER 181" + ranges + pose + pose + " " + std::to_string(stamp_s) + " h 0\n";
  };
  return scan(0.0, 1.0) + "FLASER 181 1 2 3\n" + scan(0.0, 2.0);
}

TEST_F(PlotAndLines, TheWallsOfARoomAreFoundInEveryScan) {
  const auto found = measure_lines(write("room.clf", room_log()), {});
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_EQ(found->scans, 2U);
  EXPECT_EQ(found->beams, 181U);
  EXPECT_EQ(found->lines_per_scan, 3.0);
  EXPECT_EQ(found->most_lines, 3U);
  EXPECT_GT(found->points_on_lines, 0.95);
  EXPECT_EQ(found->bad_lines, 1U);
  EXPECT_EQ(measure_lines(write("odom.clf", "ODOM 0 0 0 0 0 0 1 h 1\n"), {}).error().code, Errc::kParse);
}

TEST_F(PlotAndLines, OneScanIsDrawnWithItsLines) {
  LinesOptions options;
  options.log = write("room.clf", room_log());
  options.config = testing::source_file("config");
  options.scan = 1;
  options.out = folder() / "scan.png";
  std::ostringstream out;
  const Status done = run_lines(options, out);
  ASSERT_TRUE(done) << done.error().message;
  EXPECT_TRUE(image::read_png(options.out));
  EXPECT_EQ(out.str(), "wrote " + options.out.string() + "\n");
  options.json = true;
  ASSERT_TRUE(run_lines(options, out));
  EXPECT_NE(out.str().find("\"file\": \"" + options.out.string() + "\""), std::string::npos) << out.str();
  options.json = false;
  options.scan = 2;
  EXPECT_EQ(run_lines(options, out).error().code, Errc::kNotFound);
  options.scan.reset();
  options.json = true;
  ASSERT_TRUE(run_lines(options, out));
  EXPECT_NE(out.str().find("\"lines_per_scan\": 3"), std::string::npos);
}

TEST_F(PlotAndLines, TrajectoriesAreDrawnOverTheWallsOfTheirLog) {
  PlotOptions options;
  options.trajectories = {write("a.tum", "1 0 0 0 0 0 0 1\n2 0.5 0 0 0 0 0 1\n"),
                          write("b.tum", "1 9 9 0 0 0 0 1\n2 9 9.5 0 0 0 0.70710678 0.70710678\n")};
  options.log = write("room.clf", room_log());
  options.config = testing::source_file("config");
  options.out = folder() / "plot.png";
  options.align = true;
  std::ostringstream out;
  const Status done = run_plot(options, out);
  ASSERT_TRUE(done) << done.error().message;
  EXPECT_EQ(out.str(), "wrote " + options.out.string() + "\n");
  const auto picture = image::read_png(options.out);
  ASSERT_TRUE(picture);
  // The first trajectory can be seen.
  const auto& colour = image::series_colour(0);
  int blue = 0;
  for (int v = 0; v < picture->height_px(); ++v) {
    for (int u = 0; u < picture->width_px(); ++u) {
      const std::uint8_t* pixel = picture->at(u, v);
      blue +=
          std::abs(pixel[0] - colour.red) + std::abs(pixel[1] - colour.green) + std::abs(pixel[2] - colour.blue) < 60;
    }
  }
  EXPECT_GT(blue, 50);
  options.trajectories.push_back(folder() / "none.tum");
  EXPECT_EQ(run_plot(options, out).error().code, Errc::kNotFound);
}

TEST(TimeFigures, AreEntriesOfTheList) {
  std::vector<double> times_s(200, 0.001);
  times_s[7] = 0.005;
  times_s[8] = 0.009;
  times_s[9] = 0.002;
  const TimeFigures figures = time_figures(times_s);
  EXPECT_NEAR(figures.median_ms, 1.0, 1e-12);
  EXPECT_NEAR(figures.p99_ms, 2.0, 1e-12);
  EXPECT_NEAR(figures.max_ms, 9.0, 1e-12);
  EXPECT_NEAR(figures.mean_ms, (197.0 + 16.0) / 200.0, 1e-12);
  EXPECT_EQ(time_figures({}).max_ms, 0.0);
}

}  // namespace
}  // namespace seeker::lab
