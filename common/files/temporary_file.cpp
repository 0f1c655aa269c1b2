#include "common/files/temporary_file.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "common/files/file_error.hpp"

namespace seeker::files {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMark = ".tmp-";
constexpr std::string_view kRandom = "XXXXXX";
/// What SQLite keeps beside a database that is being written.
constexpr std::string_view kJournal = "-journal";

/// False when whoever removes what was left over came between making and locking it.
bool locked_and_there(int fd) {
  struct stat status {};
  return ::flock(fd, LOCK_EX | LOCK_NB) == 0 && ::fstat(fd, &status) == 0 && status.st_nlink > 0;
}

bool is_temporary(std::string name) {
  if (name.ends_with(kJournal)) {
    name.resize(name.size() - kJournal.size());
  }
  const std::size_t end = kMark.size() + kRandom.size();
  return name.size() > end && std::string_view(name).substr(name.size() - end, kMark.size()) == kMark &&
         std::all_of(name.end() - static_cast<std::ptrdiff_t>(kRandom.size()), name.end(),
                     [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; });
}

/// Of a temporary file or of a database's journal beside one.
bool being_written(const fs::path& path) {
  std::string file = path.string();
  if (file.ends_with(kJournal)) {
    file.resize(file.size() - kJournal.size());
  }
  const FileDescriptor opened(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
  return opened.get() >= 0 && ::flock(opened.get(), LOCK_EX | LOCK_NB) != 0;
}

}  // namespace

Result<TemporaryFile> TemporaryFile::beside(const fs::path& path, ReadableBy readers) {
  constexpr mode_t kForAll = 0644;
  constexpr mode_t kForOwner = 0600;
  const mode_t mode = readers == ReadableBy::kOwner ? kForOwner : kForAll;
  constexpr int kAttempts = 10;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    std::string name = path.string() + std::string(kMark) + std::string(kRandom);
    FileDescriptor file(::mkostemp(name.data(), O_CLOEXEC));
    if (file.get() < 0 || ::fchmod(file.get(), mode) != 0) {
      return cannot_write(path, errno);
    }
    if (locked_and_there(file.get())) {
      return TemporaryFile(name, std::move(file));
    }
  }
  return cannot_write(path, EAGAIN);
}

TemporaryFile::TemporaryFile(TemporaryFile&& other) noexcept
    : path_(std::exchange(other.path_, {})), file_(std::move(other.file_)) {}

TemporaryFile::~TemporaryFile() {
  if (!path_.empty()) {
    ::unlink(path_.c_str());
  }
}

Status TemporaryFile::move_to(const fs::path& path) {
  // Renamed while it is locked, but closed before: some file systems report a failed write only then.
  const FileDescriptor lock(::fcntl(file_.get(), F_DUPFD_CLOEXEC, 0));
  if (lock.get() < 0 || !file_.close() || ::rename(path_.c_str(), path.c_str()) != 0) {
    return cannot_write(path, errno);
  }
  path_.clear();
  return {};
}

std::size_t remove_left_over(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> found;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (entry->is_regular_file(error) && is_temporary(entry->path().filename().string()) &&
        !being_written(entry->path())) {
      found.push_back(entry->path());
    }
  }
  return static_cast<std::size_t>(
      std::count_if(found.begin(), found.end(), [&](const fs::path& path) { return fs::remove(path, error); }));
}

}  // namespace seeker::files
