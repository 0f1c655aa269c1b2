/// \file
/// A disk that loses power: what SQLite has written since its last sync is on it in part, or not at all.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sqlite3.h>

#include "common/core/rng.hpp"

namespace seeker::testing {

/// While it lives, every database of this process is on it. Files are where they are named; this object knows beside
/// them what of each would be there after a power cut: what was synced, and any part of what was written since.
class PowerCutDisk {
 public:
  PowerCutDisk() : real_(sqlite3_vfs_find(nullptr)), vfs_(*real_) {
    disk() = this;
    vfs_.pNext = nullptr;
    vfs_.zName = "power-cut";
    vfs_.szOsFile = static_cast<int>(sizeof(File)) + real_->szOsFile;
    vfs_.xOpen = &open;
    vfs_.xDelete = &remove;
    EXPECT_EQ(sqlite3_vfs_register(&vfs_, 1), SQLITE_OK);
  }
  PowerCutDisk(const PowerCutDisk&) = delete;
  PowerCutDisk& operator=(const PowerCutDisk&) = delete;
  ~PowerCutDisk() {
    sqlite3_vfs_unregister(&vfs_);
    disk() = nullptr;
  }

  /// The power goes when so many more writes, truncations, syncs and removals have been asked for; `at_cut` is called
  /// then. The program goes on and does not notice.
  void cut_after(std::size_t operations, std::function<void()> at_cut) {
    left_ = operations;
    at_cut_ = std::move(at_cut);
    cut_.reset();
  }
  [[nodiscard]] bool was_cut() const { return cut_.has_value(); }
  /// Writes into `folder` what is on the disk when the power is back. Of what was not synced each write is there, or
  /// not, or in its first bytes only; so is a file that was made or removed.
  void restore(const std::filesystem::path& folder, Rng& rng) const {
    for (const auto& [path, image] : *cut_) {
      const bool new_name = rng.below(2) == 0;
      std::optional<std::string> content = image.on_disk;
      if (image.name_synced || new_name) {
        content = image.removed ? std::nullopt : std::optional(after_cut(image, rng));
      }
      if (content) {
        std::ofstream(folder / std::filesystem::path(path).filename(), std::ios::binary) << *content;
      }
    }
  }

 private:
  struct Change {
    std::size_t offset = 0;
    std::string bytes;
    bool truncates = false;  ///< to `offset`
  };
  /// What is under one name.
  struct Image {
    std::string synced;
    std::vector<Change> changes;  ///< since then
    bool removed = false;
    bool name_synced = true;             ///< that the file was made or removed last is on the disk
    std::optional<std::string> on_disk;  ///< what a name that was not synced stood for before; nothing: no file
  };
  /// SQLite's view of a file: its methods first, then ours, then the real file.
  struct File {
    sqlite3_file base;
    Image* image;
    sqlite3_file* real;
    bool syncs_folder;  ///< with its first sync, as SQLite does for a new log
  };
  using Images = std::map<std::string, Image>;

  static PowerCutDisk*& disk() {
    static PowerCutDisk* current = nullptr;
    return current;
  }
  static File& of(sqlite3_file* file) { return *reinterpret_cast<File*>(file); }
  static sqlite3_file* real_of(sqlite3_file* file) { return of(file).real; }

  static void apply(std::string& content, const Change& change, std::size_t length) {
    if (change.truncates) {
      content.resize(change.offset);
      return;
    }
    content.resize(std::max(content.size(), change.offset + length));
    content.replace(change.offset, length, change.bytes, 0, length);
  }
  static std::string after_cut(const Image& image, Rng& rng) {
    std::string content = image.synced;
    for (const Change& change : image.changes) {
      constexpr std::uint64_t kFates = 3;
      const std::uint64_t fate = rng.below(kFates);
      if (fate > 0) {
        apply(content, change, fate == 1 ? rng.below(change.bytes.size() + 1) : change.bytes.size());
      }
    }
    return content;
  }

  void operation() {
    if (left_ > 0 && --left_ == 0) {
      cut_ = images_;
      at_cut_();
    }
  }
  static void sync(Image& image) {
    for (const Change& change : image.changes) {
      apply(image.synced, change, change.bytes.size());
    }
    image.changes.clear();
  }
  void sync_folder() {
    for (auto& [path, image] : images_) {
      image.name_synced = true;
    }
  }
  /// A name that stands for a new file, or for none.
  static void rename(Image& image, bool removed) {
    if (image.name_synced) {
      image.on_disk = image.removed ? std::nullopt : std::optional(image.synced);
    }
    image = {.synced = "", .changes = {}, .removed = removed, .name_synced = false, .on_disk = image.on_disk};
  }

  static int open(sqlite3_vfs* vfs, const char* name, sqlite3_file* file, int flags, int* out_flags) {
    PowerCutDisk& self = *disk();
    File& ours = of(file);
    ours.real = reinterpret_cast<sqlite3_file*>(reinterpret_cast<char*>(file) + sizeof(File));
    const int code = self.real_->xOpen(self.real_, name, ours.real, flags, out_flags);
    static const sqlite3_io_methods kMethods = methods();
    ours.base.pMethods = code == SQLITE_OK ? &kMethods : nullptr;
    const auto [found, first] = self.images_.try_emplace(name != nullptr ? name : "temporary");
    found->second.removed = found->second.removed || first;
    if (found->second.removed) {
      rename(found->second, false);
    }
    ours.image = &found->second;
    ours.syncs_folder = (flags & (SQLITE_OPEN_MAIN_JOURNAL | SQLITE_OPEN_WAL)) != 0 && !found->second.name_synced;
    static_cast<void>(vfs);
    return code;
  }
  static int remove(sqlite3_vfs* /*vfs*/, const char* name, int sync_folder) {
    PowerCutDisk& self = *disk();
    const int code = self.real_->xDelete(self.real_, name, 0);
    if (const auto found = self.images_.find(name); code == SQLITE_OK && found != self.images_.end()) {
      self.operation();
      rename(found->second, true);
      if (sync_folder != 0) {
        self.sync_folder();
      }
    }
    return code;
  }

  static sqlite3_io_methods methods() {
    sqlite3_io_methods m{};
    m.iVersion = 1;  // neither shared memory nor mapped files, which bypass writes
    m.xClose = [](sqlite3_file* f) { return real_of(f)->pMethods->xClose(real_of(f)); };
    m.xRead = [](sqlite3_file* f, void* to, int n, sqlite3_int64 at) {
      return real_of(f)->pMethods->xRead(real_of(f), to, n, at);
    };
    m.xWrite = [](sqlite3_file* f, const void* from, int n, sqlite3_int64 at) {
      const std::string bytes(static_cast<const char*>(from), static_cast<std::size_t>(n));
      of(f).image->changes.push_back({static_cast<std::size_t>(at), bytes, false});
      disk()->operation();
      return real_of(f)->pMethods->xWrite(real_of(f), from, n, at);
    };
    m.xTruncate = [](sqlite3_file* f, sqlite3_int64 size) {
      of(f).image->changes.push_back({static_cast<std::size_t>(size), "", true});
      disk()->operation();
      return real_of(f)->pMethods->xTruncate(real_of(f), size);
    };
    m.xSync = [](sqlite3_file* f, int /*flags*/) {
      disk()->operation();  // cut in the middle of it: as if it had not begun
      sync(*of(f).image);
      if (of(f).syncs_folder) {
        disk()->sync_folder();
        of(f).syncs_folder = false;
      }
      return SQLITE_OK;
    };
    m.xFileSize = [](sqlite3_file* f, sqlite3_int64* size) {
      return real_of(f)->pMethods->xFileSize(real_of(f), size);
    };
    m.xLock = [](sqlite3_file* f, int level) { return real_of(f)->pMethods->xLock(real_of(f), level); };
    m.xUnlock = [](sqlite3_file* f, int level) { return real_of(f)->pMethods->xUnlock(real_of(f), level); };
    m.xCheckReservedLock = [](sqlite3_file* f, int* out) {
      return real_of(f)->pMethods->xCheckReservedLock(real_of(f), out);
    };
    m.xFileControl = [](sqlite3_file* f, int what, void* argument) {
      return real_of(f)->pMethods->xFileControl(real_of(f), what, argument);
    };
    m.xSectorSize = [](sqlite3_file* f) { return real_of(f)->pMethods->xSectorSize(real_of(f)); };
    m.xDeviceCharacteristics = [](sqlite3_file* f) { return real_of(f)->pMethods->xDeviceCharacteristics(real_of(f)); };
    return m;
  }

  sqlite3_vfs* real_;
  sqlite3_vfs vfs_;
  Images images_;
  std::optional<Images> cut_;
  std::size_t left_ = 0;
  std::function<void()> at_cut_;
};

}  // namespace seeker::testing
