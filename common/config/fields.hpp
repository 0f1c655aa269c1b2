/// \file
/// A parameter struct is described once, by a function `void describe(config::Fields& f, T& params)` found beside its
/// options; reading a YAML file and printing the effective values both run that description.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/core/polygon.hpp"
#include "common/core/pose2.hpp"
#include "common/core/time.hpp"

namespace seeker::config {

/// Largest list in a file.
inline constexpr std::size_t kMaxListItems = 100'000;

/// Names of an enum's values as they stand in a file.
template <class E>
using Choices = std::vector<std::pair<std::string_view, E>>;

/// The choices that a list of all values of an enum gives, each by its to_string().
template <class Values>
[[nodiscard]] auto choices_of(const Values& values) {
  Choices<typename Values::value_type> choices;
  for (const auto value : values) {
    choices.emplace_back(to_string(value), value);
  }
  return choices;
}

/// Visits the fields of a struct. A field that a file does not mention keeps its value: defaults live in code.
class Fields {
 public:
  Fields() = default;
  Fields(const Fields&) = delete;
  Fields& operator=(const Fields&) = delete;
  virtual ~Fields() = default;

  virtual void field(std::string_view key, double& value) = 0;
  virtual void field(std::string_view key, int& value) = 0;
  virtual void field(std::string_view key, std::uint64_t& value) = 0;
  virtual void field(std::string_view key, bool& value) = 0;
  virtual void field(std::string_view key, std::string& value) = 0;
  virtual void field(std::string_view key, std::vector<double>& value) = 0;
  virtual void field(std::string_view key, std::vector<std::string>& value) = 0;
  /// [x_m, y_m]
  virtual void field(std::string_view key, Point2& value) = 0;
  /// [[x_m, y_m], ...]
  virtual void field(std::string_view key, Polygon& value) = 0;
  /// [x_m, y_m, heading in degrees]
  virtual void field(std::string_view key, Pose2& value) = 0;

  /// An angle or angular rate that is radians in code and degrees in the file; name the key `..._deg`.
  void angle_deg(std::string_view key, double& value_rad);
  void angles_deg(std::string_view key, std::vector<double>& values_rad);
  /// A duration, in seconds in the file; name the key `..._s`.
  void seconds(std::string_view key, Duration& value);

  template <class E>
  void choice(std::string_view key, E& value, const Choices<E>& choices) {
    std::vector<std::string_view> names;
    std::string name;
    for (const auto& [text, option] : choices) {
      names.push_back(text);
      if (option == value) {
        name = text;
      }
    }
    field(key, name);
    for (const auto& [text, option] : choices) {
      if (text == name) {
        value = option;
        return;
      }
    }
    refuse_choice(key, name, names);
  }

  /// A nested struct with its own describe().
  template <class T>
  void section(std::string_view key, T& value) {
    if (enter(key)) {
      describe(*this, value);
      leave();
    }
  }

  /// A nested struct or value that may be absent altogether.
  template <class T>
  void optional_section(std::string_view key, std::optional<T>& value) {
    if (has(key) && !value) {
      value.emplace();
    }
    if (value) {
      section(key, *value);
    }
  }
  template <class T>
  void optional_field(std::string_view key, std::optional<T>& value) {
    if (has(key) && !value) {
      value.emplace();
    }
    if (value) {
      field(key, *value);
    }
  }

  /// A list of structs; a list in a file replaces the default as a whole.
  template <class T>
  void list(std::string_view key, std::vector<T>& values) {
    const std::optional<std::size_t> count = enter_list(key, values.size());
    if (!count) {
      return;
    }
    if (reading()) {
      values.assign(*count, T());
    }
    for (std::size_t i = 0; i < *count; ++i) {
      enter_item(i);
      describe(*this, values[i]);
      leave();
    }
    leave();
  }

  /// Reports a missing key as an error.
  virtual void require(std::string_view key) = 0;
  /// Reports `message` at the key's place unless `ok`. Ranges are checked where the field is read.
  virtual void check(std::string_view key, bool ok, std::string_view message) = 0;
  /// True when the file mentions the key.
  [[nodiscard]] virtual bool has(std::string_view key) const = 0;
  /// True while values are being read (false: printed).
  [[nodiscard]] virtual bool reading() const = 0;

 protected:
  [[nodiscard]] virtual bool enter(std::string_view key) = 0;
  [[nodiscard]] virtual std::optional<std::size_t> enter_list(std::string_view key, std::size_t size) = 0;
  virtual void enter_item(std::size_t index) = 0;
  virtual void leave() = 0;
  virtual void refuse_choice(std::string_view key, const std::string& got,
                             const std::vector<std::string_view>& allowed) = 0;
};

}  // namespace seeker::config
