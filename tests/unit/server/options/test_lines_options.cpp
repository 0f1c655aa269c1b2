#include "server/options/lines_options.hpp"

#include <gtest/gtest.h>

#include "common/config/yaml.hpp"

namespace seeker::lines {
namespace {

template <class T>
Status read(const std::string& text, T& params) {
  const auto document = config::Document::parse(text, "lines.yaml");
  return document ? document->read(params) : Status(tl::unexpected<Error>(document.error()));
}

TEST(LinesOptions, ReadWhatAFileSaysAndKeepTheRest) {
  FastParams fast;
  ASSERT_TRUE(read("noise: {sigma_m: 0.02}\nmin_points: 9\nbearing_sigma_deg: 0.1\n", fast));
  EXPECT_DOUBLE_EQ(fast.noise.sigma_m, 0.02);
  EXPECT_EQ(fast.min_points, 9);
  EXPECT_NEAR(fast.bearing_sigma_rad, 0.1 * 3.14159265358979 / 180.0, 1e-12);
  EXPECT_DOUBLE_EQ(fast.split_sigmas, FastParams{}.split_sigmas);
  PaperParams paper;
  ASSERT_TRUE(read("start: {corner_m: 0.03}\nshrink: 0.7\n", paper));
  EXPECT_DOUBLE_EQ(paper.start.corner_m, 0.03);
  EXPECT_DOUBLE_EQ(paper.shrink, 0.7);
  ObservationParams observation;
  ASSERT_TRUE(read("wall_sigma_m: 0.02\n", observation));
  EXPECT_DOUBLE_EQ(observation.wall_sigma_m, 0.02);
}

TEST(LinesOptions, NameTheExtractorAndTheParametersOfEach) {
  ExtractorParams params;
  ASSERT_TRUE(read("extractor: regression\nregression: {window_points: 11}\nsplit: {split_m: 0.03}\n", params));
  EXPECT_EQ(params.kind, ExtractorKind::kRegression);
  EXPECT_EQ(params.regression.window_points, 11);
  EXPECT_DOUBLE_EQ(params.split.split_m, 0.03);
  for (const ExtractorKind kind : kExtractorKinds) {
    ASSERT_TRUE(read("extractor: " + std::string(to_string(kind)) + "\n", params));
    EXPECT_EQ(params.kind, kind);
  }
}

TEST(LinesOptions, RefuseWhatMakesNoSense) {
  ExtractorParams extractor;
  EXPECT_FALSE(read("extractor: hough\n", extractor));
  EXPECT_FALSE(read("regression: {window_points: 2}\n", extractor));

  FastParams fast;
  EXPECT_FALSE(read("min_points: 2\n", fast));
  EXPECT_FALSE(read("splitsigmas: 3\n", fast));
  EXPECT_FALSE(read("noise: {min_sigma_m: 0.5}\n", fast));
  PaperParams paper;
  EXPECT_FALSE(read("shrink: 1.0\n", paper));
}

}  // namespace
}  // namespace seeker::lines
