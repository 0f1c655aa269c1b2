/// \file
/// Runs a fuzz target over its corpus without libFuzzer, so that every build and compiler replays what was found.
/// Usage: replay_NAME FILE|FOLDER...

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

namespace fs = std::filesystem;

/// The files under every argument, sorted; nothing when an argument is missing or an empty folder.
std::optional<std::vector<fs::path>> corpus_files(int argc, char** argv) {
  std::vector<fs::path> files;
  for (int i = 1; i < argc; ++i) {
    const fs::path argument = argv[i];
    const std::size_t before = files.size();
    if (fs::is_regular_file(argument)) {
      files.push_back(argument);
    } else if (fs::is_directory(argument)) {
      for (const fs::directory_entry& entry : fs::recursive_directory_iterator(argument)) {
        if (entry.is_regular_file()) {
          files.push_back(entry.path());
        }
      }
    }
    if (files.size() == before) {
      std::fprintf(stderr, "%s: no such file, or a folder without inputs\n", argument.c_str());
      return std::nullopt;
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

int main(int argc, char** argv) {
  const auto files = corpus_files(argc, argv);
  if (!files || files->empty()) {
    std::fprintf(stderr, "usage: %s FILE|FOLDER...\n", argv[0]);
    return 1;
  }
  for (const fs::path& file : *files) {
    std::ifstream in(file, std::ios::binary);
    if (!in) {
      std::fprintf(stderr, "%s: cannot be read\n", file.c_str());
      return 1;
    }
    const std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    // The name first: when the target aborts, the last line says which input did it.
    std::printf("%s (%zu bytes)\n", file.c_str(), bytes.size());
    std::fflush(stdout);
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  }
  std::printf("%zu inputs replayed\n", files->size());
  return 0;
}
