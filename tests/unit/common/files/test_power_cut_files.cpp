// A file that is written is whole or as it was, at whatever moment the power goes: in which order the operating system
// is asked to write, sync and rename.

#include <cstring>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "common/files/files.hpp"
#include "tests/unit/server/store/temporary_folder.hpp"

namespace seeker::files {
namespace {

using testing::TemporaryFolder;

struct Operation {
  enum class Kind { kWrite, kSync, kRename };
  Kind kind;
  std::string path;    ///< of the file or folder; the old name
  std::string detail;  ///< the bytes, or the new name
};

/// What has been asked for since it was emptied.
std::vector<Operation>& operations() {
  static std::vector<Operation> all;
  return all;
}

std::string path_of(int descriptor) {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(descriptor), error).string();
}

}  // namespace
}  // namespace seeker::files

// The linker has the program call these in place of the functions of the system (--wrap in CMakeLists.txt).
// NOLINTBEGIN(readability-identifier-naming)
extern "C" {
ssize_t __real_write(int descriptor, const void* bytes, std::size_t size);
int __real_fsync(int descriptor);
int __real_rename(const char* from, const char* to);

ssize_t __wrap_write(int descriptor, const void* bytes, std::size_t size) {
  using namespace seeker::files;
  operations().push_back(
      {Operation::Kind::kWrite, path_of(descriptor), std::string(static_cast<const char*>(bytes), size)});
  return __real_write(descriptor, bytes, size);
}
int __wrap_fsync(int descriptor) {
  using namespace seeker::files;
  operations().push_back({Operation::Kind::kSync, path_of(descriptor), ""});
  return __real_fsync(descriptor);
}
int __wrap_rename(const char* from, const char* to) {
  using namespace seeker::files;
  operations().push_back({Operation::Kind::kRename, from, to});
  return __real_rename(from, to);
}
}
// NOLINTEND(readability-identifier-naming)

namespace seeker::files {
namespace {

/// What `file`, which held `old`, may hold when the power goes after the first `done` operations: a name that was not
/// synced may be either one, bytes that were not may be there in part.
std::set<std::string> after_cut(const std::filesystem::path& file, const std::string& old, std::size_t done) {
  std::map<std::string, std::string> written;
  std::map<std::string, std::string> synced;
  std::string renamed;
  bool name_synced = false;
  for (std::size_t k = 0; k < done; ++k) {
    const Operation& one = operations()[k];
    switch (one.kind) {
      case Operation::Kind::kWrite: written[one.path] += one.detail; break;
      case Operation::Kind::kSync:
        synced[one.path] = written[one.path];
        name_synced = name_synced || (!renamed.empty() && one.path == file.parent_path());
        break;
      case Operation::Kind::kRename: renamed = one.detail == file ? one.path : renamed; break;
    }
  }
  std::set<std::string> contents;
  if (!name_synced) {
    contents.insert(old);
  }
  if (!renamed.empty()) {
    const std::string& all = written[renamed];
    contents.insert(all);
    for (std::size_t kept = synced[renamed].size(); kept < all.size(); ++kept) {
      contents.insert(all.substr(0, kept));
    }
  }
  return contents;
}

TEST(PowerCutFiles, FileIsWholeOrAsItWasAfterACutAtAnyOperationAndNewOnceThatIsTold) {
  const TemporaryFolder folder;
  const std::filesystem::path file = std::filesystem::canonical(folder.path()) / "map.seekermap";
  const std::string before = "what was there";
  const std::string after = "the new content, which is longer";
  ASSERT_TRUE(write_file(file, before));
  operations().clear();
  ASSERT_TRUE(write_file(file, after));
  ASSERT_GE(operations().size(), 4U) << "write, sync, rename, sync of the folder";
  const std::set<std::string> allowed{before, after};
  for (std::size_t done = 0; done <= operations().size(); ++done) {
    for (const std::string& content : after_cut(file, before, done)) {
      EXPECT_TRUE(allowed.contains(content)) << "'" << content << "' after " << done << " operations";
    }
  }
  EXPECT_EQ(after_cut(file, before, operations().size()), std::set<std::string>{after});
}

TEST(PowerCutFiles, FileThatOutlivesItsProgramOnlyDoesNotWaitForTheDisk) {
  const TemporaryFolder folder;
  operations().clear();
  ASSERT_TRUE(write_file(folder.path() / "place", std::vector<std::uint8_t>{1, 2, 3}, Outlives::kItsProgram));
  for (const Operation& one : operations()) {
    EXPECT_NE(one.kind, Operation::Kind::kSync) << one.path;
  }
}

TEST(PowerCutFiles, NewFoldersAreOnTheDiskBeforeWhatIsPutIntoThem) {
  const TemporaryFolder folder;
  const std::filesystem::path top = std::filesystem::canonical(folder.path());
  operations().clear();
  ASSERT_TRUE(make_folder(top / "maps" / "checkpoints" / "seeker-1"));
  std::set<std::string> synced;
  for (const Operation& one : operations()) {
    synced.insert(one.path);
  }
  EXPECT_EQ(synced, (std::set<std::string>{top, top / "maps", top / "maps" / "checkpoints"}));
  operations().clear();
  ASSERT_TRUE(make_folder(top / "maps"));
  EXPECT_TRUE(operations().empty()) << "it was there";
}

}  // namespace
}  // namespace seeker::files
