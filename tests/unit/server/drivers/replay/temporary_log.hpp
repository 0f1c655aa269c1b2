/// \file
/// A log for one test.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>
#include <zlib.h>

namespace seeker::drivers {

/// A file of its own that is gone after the test.
class TemporaryLog {
 public:
  TemporaryLog(const std::string& name, const std::string& text, bool compressed = false)
      : path_(std::filesystem::temp_directory_path() /
              ("seeker_" + std::to_string(getpid()) + "_" + name + (compressed ? ".gz" : ""))) {
    if (compressed) {
      gzFile file = gzopen(path_.c_str(), "wb");
      gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
      gzclose(file);
    } else {
      std::ofstream(path_, std::ios::binary) << text;
    }
  }
  TemporaryLog(const TemporaryLog&) = delete;
  TemporaryLog& operator=(const TemporaryLog&) = delete;
  ~TemporaryLog() { std::filesystem::remove(path_); }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace seeker::drivers
