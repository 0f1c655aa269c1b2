/// \file
/// Collects the first error in a message, with the path of its field.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "common/core/result.hpp"
#include "common/wire/limits.hpp"

namespace seeker::wire {

/// Passed through all readers of a message. After the first error further ones are ignored, and readers may continue
/// with defaults, since the value that they make is discarded.
class Check {
 public:
  /// Extends the path of fields during its lifetime.
  class Scope {
   public:
    Scope(Check& check, std::string_view name, std::size_t index) : check_(check), length_(check.path_.size()) {
      if (!check.path_.empty()) {
        check.path_ += '.';
      }
      check.path_ += name;
      if (index != kNoIndex) {
        check.path_ += "[" + std::to_string(index) + "]";
      }
    }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;
    ~Scope() { check_.path_.resize(length_); }

   private:
    Check& check_;
    std::size_t length_;
  };
  static constexpr std::size_t kNoIndex = std::numeric_limits<std::size_t>::max();

  [[nodiscard]] Scope in(std::string_view name, std::size_t index = kNoIndex) { return {*this, name, index}; }

  void refuse(std::string_view field, Errc code, std::string_view sentence) {
    if (status_) {
      std::string path = path_;
      if (!field.empty()) {
        path += (path.empty() ? "" : ".");
        path += field;
      }
      status_ = seeker::fail(code, "field '" + path + "' " + std::string(sentence));
    }
  }
  bool require(std::string_view field, bool present) {
    if (!present) {
      refuse(field, Errc::kInvalidArgument, "is missing");
    }
    return present;
  }
  double finite(std::string_view field, double value) {
    if (!std::isfinite(value)) {
      refuse(field, Errc::kInvalidArgument, "is not a finite number");
    }
    return value;
  }
  bool count(std::string_view field, std::size_t size, std::size_t limit) {
    if (size > limit) {
      refuse(field, Errc::kTooLarge,
             "has " + std::to_string(size) + " entries; at most " + std::to_string(limit) + " are allowed");
      return false;
    }
    return true;
  }
  std::string text(std::string_view field, const std::string& value, std::size_t limit = kMaxTextBytes) {
    if (value.size() > limit) {
      refuse(field, Errc::kTooLarge, "is longer than " + std::to_string(limit) + " bytes");
      return {};
    }
    return value;
  }
  int natural(std::string_view field, std::uint32_t value) {
    if (value > static_cast<std::uint32_t>(std::numeric_limits<int>::max())) {
      refuse(field, Errc::kInvalidArgument, "is too large a number");
      return 0;
    }
    return static_cast<int>(value);
  }
  /// Reads an enumerator: on the wire it is one larger than in E, since zero means unspecified there.
  template <class E>
  void enumerator(std::string_view field, int value, E last, E& out) {
    if (value < 1 || value > static_cast<int>(last) + 1) {
      refuse(field, Errc::kInvalidArgument,
             value == 0 ? "is not specified" : "has the value " + std::to_string(value) + ", which is not known here");
      return;
    }
    out = static_cast<E>(value - 1);
  }

  [[nodiscard]] bool ok() const { return status_.has_value(); }
  [[nodiscard]] const Status& status() const { return status_; }

 private:
  std::string path_;
  Status status_;
};

}  // namespace seeker::wire
