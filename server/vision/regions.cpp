#include "server/vision/regions.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "server/vision/binarise.hpp"

namespace seeker::vision {
namespace {

/// Columns [begin, end) of one row, all of one class.
struct Run {
  int begin = 0;
  int end = 0;
  int label = 0;
  std::uint8_t value = 0;
};

/// Bounds of the pixels that carry one label.
struct Extent {
  int left = 0;
  int right = 0;  // exclusive
  int top = 0;
  int bottom = 0;  // inclusive
  int area = 0;
  std::uint8_t value = 0;
};

class Labels {
 public:
  int add(int row, const Run& run) {
    parent_.push_back(static_cast<int>(parent_.size()));
    extents_.push_back({run.begin, run.end, row, row, 0, run.value});
    return parent_.back();
  }

  int root(int label) {
    while (parent_[index(label)] != label) {
      parent_[index(label)] = parent_[index(parent_[index(label)])];
      label = parent_[index(label)];
    }
    return label;
  }

  /// The older label stays the root, so that the order of regions is that of their first pixel.
  int unite(int a, int b) {
    a = root(a);
    b = root(b);
    parent_[index(std::max(a, b))] = std::min(a, b);
    return std::min(a, b);
  }

  void extend(int row, const Run& run) {
    Extent& extent = extents_[index(run.label)];
    extent.left = std::min(extent.left, run.begin);
    extent.right = std::max(extent.right, run.end);
    extent.bottom = row;
    extent.area += run.end - run.begin;
  }

  std::vector<Region> regions() {
    for (std::size_t label = extents_.size(); label-- > 0;) {
      const std::size_t up = index(root(static_cast<int>(label)));
      if (up != label) {
        fold(extents_[label], extents_[up]);
      }
    }
    std::vector<Region> out;
    for (std::size_t label = 0; label < extents_.size(); ++label) {
      if (index(parent_[label]) == label) {
        const Extent& e = extents_[label];
        out.push_back(
            {cv::Rect(e.left, e.top, e.right - e.left, e.bottom - e.top + 1), e.area, e.value == kLightClass});
      }
    }
    return out;
  }

 private:
  static std::size_t index(int label) { return static_cast<std::size_t>(label); }

  static void fold(const Extent& from, Extent& into) {
    into.left = std::min(into.left, from.left);
    into.right = std::max(into.right, from.right);
    into.top = std::min(into.top, from.top);
    into.bottom = std::max(into.bottom, from.bottom);
    into.area += from.area;
  }

  std::vector<int> parent_;
  std::vector<Extent> extents_;
};

/// First column from `column` on whose value differs from the one at `column`.
int end_of_run(const std::uint8_t* row, int column, int columns) {
  const std::uint8_t value = row[column];
  const std::uint64_t pattern = 0x0101010101010101ULL * value;
  constexpr int kStride = 8;
  while (column + kStride <= columns) {
    std::uint64_t eight = 0;
    std::memcpy(&eight, row + column, sizeof eight);
    if (eight != pattern) {
      break;
    }
    column += kStride;
  }
  while (column < columns && row[column] == value) {
    ++column;
  }
  return column;
}

void find_runs(const std::uint8_t* row, int columns, std::vector<Run>& runs) {
  runs.clear();
  for (int column = 0; column < columns;) {
    const int end = end_of_run(row, column, columns);
    if (row[column] != kNoClass) {
      runs.push_back({column, end, 0, row[column]});
    }
    column = end;
  }
}

void join_row(int row, const std::vector<Run>& above, std::vector<Run>& runs, Labels& labels) {
  std::size_t first = 0;
  for (Run& run : runs) {
    // 8-connected: runs that meet at a corner touch too.
    while (first < above.size() && above[first].end < run.begin) {
      ++first;
    }
    int label = -1;
    for (std::size_t i = first; i < above.size() && above[i].begin <= run.end; ++i) {
      if (above[i].value == run.value) {
        label = label < 0 ? labels.root(above[i].label) : labels.unite(label, above[i].label);
      }
    }
    run.label = label < 0 ? labels.add(row, run) : label;
    labels.extend(row, run);
  }
}

}  // namespace

std::vector<Region> grow_regions(const cv::Mat& classes) {
  Labels labels;
  std::vector<Run> above;
  std::vector<Run> runs;
  for (int row = 0; row < classes.rows; ++row) {
    find_runs(classes.ptr<std::uint8_t>(row), classes.cols, runs);
    join_row(row, above, runs, labels);
    above.swap(runs);
  }
  return labels.regions();
}

}  // namespace seeker::vision
