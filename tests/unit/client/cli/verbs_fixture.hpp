/// \file
/// Runs command lines against a robot in memory, with a folder of files of its own.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <unistd.h>

#include <gtest/gtest.h>

#include "common/image/png.hpp"
#include "tests/unit/client/cli/cli_fixture.hpp"

namespace seeker::cli {

/// The folder holds board.png, the picture of a target.
class VerbsFixture : public ::testing::Test, public CliFixture {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::path(::testing::TempDir()) / ("seeker_cli_" + std::to_string(::getpid()) + "_" +
                                                       ::testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
    Image picture(32, 32, 1);
    for (int v = 0; v < 32; ++v) {
      for (int u = 0; u < 32; ++u) {
        *picture.at(u, v) = static_cast<std::uint8_t>((u / 4 + v / 4) % 2 == 0 ? 20 : 230);
      }
    }
    ASSERT_TRUE(image::write_png(folder_ / "board.png", picture));
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string read(const std::string& name) const {
    std::ifstream file(folder_ / name);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }

  std::filesystem::path folder_;
};

}  // namespace seeker::cli
