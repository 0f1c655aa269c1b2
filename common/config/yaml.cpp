#include "common/config/yaml.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "common/config/yaml_guard.hpp"
#include "common/core/angle.hpp"

namespace seeker::config {
namespace {

std::string join(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) {
    text += (text.empty() ? "" : ", ") + word;
  }
  return text;
}

/// Sets the value of "a.b.c=text" in the tree; absent maps on its path are added.
Status apply_override(const YAML::Node& root, const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0) {
    return fail(Errc::kInvalidArgument, "--set " + assignment + ": expected key.path=value");
  }
  YAML::Node node = root;
  std::stringstream path(assignment.substr(0, equals));
  std::string key;
  std::vector<std::string> keys;
  while (std::getline(path, key, '.')) {
    keys.push_back(key);
  }
  for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
    if (node[keys[i]].IsDefined() && !node[keys[i]].IsMap()) {
      return fail(Errc::kInvalidArgument, "--set " + assignment + ": " + keys[i] + " is a value, not a section");
    }
    node.reset(node[keys[i]]);
  }
  const std::string value = assignment.substr(equals + 1);
  if (const Status ok = guard_yaml(value, "--set " + assignment); !ok) {
    return ok;
  }
  try {
    node[keys.back()] = YAML::Load(value);
  } catch (const YAML::Exception& error) {
    return fail(Errc::kParse, "--set " + assignment + ": " + error.msg);
  }
  return {};
}

}  // namespace

struct Document::Impl {
  YAML::Node root;
  std::string name;
  std::vector<std::string> overrides;
};

/// Walks the tree along a description, remembers which keys were asked for and the first error.
class Document::Reader final : public Fields {
 public:
  explicit Reader(const Impl& document) : name_(document.name), overrides_(document.overrides) {
    push(document.root, "");
  }

  void field(std::string_view key, double& value) override { scalar(key, value, "a number"); }
  void field(std::string_view key, int& value) override { scalar(key, value, "a whole number"); }
  void field(std::string_view key, std::uint64_t& value) override { scalar(key, value, "a whole number from 0"); }
  void field(std::string_view key, bool& value) override { scalar(key, value, "true or false"); }
  void field(std::string_view key, std::string& value) override { scalar(key, value, "a text"); }
  void field(std::string_view key, std::vector<double>& value) override {
    if (const auto node = find(key)) {
      read_list(key, *node, value, "a list of numbers");
    }
  }
  void field(std::string_view key, std::vector<std::string>& value) override {
    if (const auto node = find(key)) {
      read_list(key, *node, value, "a list of texts");
    }
  }
  void field(std::string_view key, Point2& value) override {
    std::vector<double> xy;
    field(key, xy);
    if (take(key, xy, 2, "[x, y]")) {
      value = {xy[0], xy[1]};
    }
  }
  void field(std::string_view key, Pose2& value) override {
    std::vector<double> pose;
    field(key, pose);
    if (take(key, pose, 3, "[x, y, heading in degrees]")) {
      value = {pose[0], pose[1], deg_to_rad(pose[2])};
    }
  }
  void field(std::string_view key, Polygon& value) override {
    const auto node = find(key);
    if (!node) {
      return;
    }
    if (!node->IsSequence() || node->size() > kMaxPolygonCorners) {
      error_at(*node, key, "expected a list of at most 256 corners [x, y]");
      return;
    }
    Polygon corners;
    for (const YAML::Node& corner : *node) {
      std::vector<double> xy;
      read_list(key, corner, xy, "a corner [x, y]");
      if (failed_ || xy.size() != 2) {
        error_at(corner, key, "expected a corner [x, y]");
        return;
      }
      corners.emplace_back(xy[0], xy[1]);
    }
    value = std::move(corners);
  }

  void require(std::string_view key) override {
    asked(key);
    if (!has(key)) {
      complain(stack_.back().node, key, "is missing");
    }
  }
  void check(std::string_view key, bool ok, std::string_view message) override {
    if (!ok) {
      const YAML::Node node = lookup(key);
      complain(node.IsDefined() ? node : stack_.back().node, key, message);
    }
  }
  [[nodiscard]] bool has(std::string_view key) const override {
    asked(key);  // who asks whether it is there knows it: it may stand here
    return lookup(key).IsDefined();
  }
  [[nodiscard]] bool reading() const override { return true; }

  [[nodiscard]] Status finish() {
    close_frame();
    return failed_ ? Status(tl::unexpected<Error>(error_)) : Status();
  }

 protected:
  bool enter(std::string_view key) override {
    const auto node = find(key);
    if (!node) {
      // Absent: describe() still runs on an empty map, so that required keys inside are noticed.
      push(YAML::Node(YAML::NodeType::Map), std::string(key));
      return true;
    }
    if (!node->IsMap()) {
      error_at(*node, key, "expected a section of key: value lines");
      return false;
    }
    push(*node, std::string(key));
    return true;
  }
  std::optional<std::size_t> enter_list(std::string_view key, std::size_t /*size*/) override {
    const auto node = find(key);
    if (!node) {
      return std::nullopt;
    }
    if (!node->IsSequence()) {
      error_at(*node, key, "expected a list");
      return std::nullopt;
    }
    if (node->size() > kMaxListItems) {
      error_at(*node, key, "has more than 100000 items");
      return std::nullopt;
    }
    push(*node, std::string(key));
    return node->size();
  }
  void enter_item(std::size_t index) override {
    const YAML::Node item = stack_.back().node[index];
    const std::string name = "[" + std::to_string(index) + "]";
    if (!item.IsMap()) {
      error_at(item, name, "expected a section of key: value lines");
      push(YAML::Node(YAML::NodeType::Map), name);
      return;
    }
    push(item, name);
  }
  void leave() override { close_frame(); }
  void refuse_choice(std::string_view key, const std::string& got,
                     const std::vector<std::string_view>& allowed) override {
    const std::vector<std::string> names(allowed.begin(), allowed.end());
    const YAML::Node node = lookup(key);
    error_at(node.IsDefined() ? node : stack_.back().node, key, "'" + got + "' is not one of " + join(names));
  }

 private:
  struct Frame {
    YAML::Node node;
    std::string key;
    mutable std::vector<std::string> allowed;
    std::optional<Error> complaint;  ///< what the whole section lacks; an unknown key in it is the likelier cause
  };

  void push(const YAML::Node& node, std::string key) { stack_.push_back({node, std::move(key), {}, {}}); }

  void asked(std::string_view key) const {
    std::vector<std::string>& allowed = stack_.back().allowed;
    if (std::find(allowed.begin(), allowed.end(), key) == allowed.end()) {
      allowed.emplace_back(key);
    }
  }

  [[nodiscard]] YAML::Node lookup(std::string_view key) const {
    const YAML::Node& node = stack_.back().node;
    return node.IsMap() ? node[std::string(key)] : YAML::Node(YAML::NodeType::Undefined);
  }

  std::optional<YAML::Node> find(std::string_view key) {
    asked(key);
    if (failed_) {
      return std::nullopt;
    }
    const YAML::Node node = lookup(key);
    return node.IsDefined() ? std::optional<YAML::Node>(node) : std::nullopt;
  }

  template <class T>
  void scalar(std::string_view key, T& value, const char* expected) {
    if (const auto node = find(key)) {
      convert(key, *node, value, expected);
    }
  }

  template <class T>
  void convert(std::string_view key, const YAML::Node& node, T& value, const char* expected) {
    T read{};
    // yaml-cpp turns "-1" into a huge unsigned number.
    const bool negative = std::is_unsigned_v<T> && node.IsScalar() && node.Scalar().starts_with('-');
    if (!node.IsScalar() || negative || !YAML::convert<T>::decode(node, read)) {
      error_at(
          node, key,
          std::string("expected ") + expected + (node.IsScalar() ? ", got '" + node.Scalar() + "'" : std::string()));
      return;
    }
    if constexpr (std::is_same_v<T, double>) {
      if (!std::isfinite(read)) {
        error_at(node, key, "must be a finite number");
        return;
      }
    }
    value = std::move(read);
  }

  template <class T>
  void read_list(std::string_view key, const YAML::Node& node, std::vector<T>& values, const char* expected) {
    if (!node.IsSequence() || node.size() > kMaxListItems) {
      error_at(node, key, std::string("expected ") + expected);
      return;
    }
    std::vector<T> read;
    for (const YAML::Node& item : node) {
      T value{};
      convert(key, item, value, expected);
      read.push_back(std::move(value));
    }
    if (!failed_) {
      values = std::move(read);
    }
  }

  bool take(std::string_view key, const std::vector<double>& numbers, std::size_t count, const char* expected) {
    if (failed_ || !has(key)) {
      return false;
    }
    if (numbers.size() != count) {
      error_at(lookup(key), key, std::string("expected ") + expected);
      return false;
    }
    return true;
  }

  /// Every key of the map must have been asked for, once.
  void close_frame() {
    const Frame& frame = stack_.back();
    if (!failed_ && frame.node.IsMap()) {
      std::set<std::string> seen;
      for (const auto& entry : frame.node) {
        const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "?";
        if (std::find(frame.allowed.begin(), frame.allowed.end(), key) == frame.allowed.end()) {
          error_at(entry.first, key, "unknown key; allowed here: " + join(frame.allowed));
          break;
        }
        if (!seen.insert(key).second) {
          error_at(entry.first, key, "stands here twice");
          break;
        }
      }
    }
    if (!failed_ && frame.complaint) {
      failed_ = true;
      error_ = *frame.complaint;
    }
    stack_.pop_back();
  }

  /// The first error of a section as a whole, reported when no key of it is unknown: "is missing" explains little of a
  /// key that is there and mistyped.
  void complain(const YAML::Node& node, std::string_view key, std::string_view message) {
    if (!failed_ && !stack_.back().complaint) {
      stack_.back().complaint = error_of(node, key, message);
    }
  }

  void error_at(const YAML::Node& node, std::string_view key, std::string_view message) {
    if (failed_) {
      return;
    }
    failed_ = true;
    error_ = error_of(node, key, message);
  }

  [[nodiscard]] Error error_of(const YAML::Node& node, std::string_view key, std::string_view message) const {
    std::string path;
    for (const Frame& frame : stack_) {
      path += (path.empty() || frame.key.starts_with('[') ? "" : ".") + frame.key;
    }
    path += (path.empty() || key.starts_with('[') ? "" : ".") + std::string(key);
    const int line = node.IsDefined() ? node.Mark().line : -1;
    const std::string place =
        set_by(path, line >= 0).value_or(line >= 0 ? name_ + ":" + std::to_string(line + 1) : name_);
    return {Errc::kParse, place + ": " + path + ": " + std::string(message)};
  }

  /// The override that says what is at `path`, or made a section of it that is not in the file.
  [[nodiscard]] std::optional<std::string> set_by(const std::string& path, bool in_file) const {
    for (const std::string& assignment : overrides_) {
      const std::string key = assignment.substr(0, assignment.find('='));
      if (path == key || path.starts_with(key + '.') || path.starts_with(key + '[') ||
          (!in_file && key.starts_with(path + '.'))) {
        return "--set " + assignment;
      }
    }
    return std::nullopt;
  }

  std::string name_;
  std::vector<std::string> overrides_;
  std::vector<Frame> stack_;
  bool failed_ = false;
  Error error_;
};

Document::Session::Session(const Document& document) : reader_(std::make_unique<Reader>(*document.impl_)) {}
Document::Session::~Session() = default;
Fields& Document::Session::fields() { return *reader_; }
Status Document::Session::finish() { return reader_->finish(); }

Document::Document(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Document::Document(Document&&) noexcept = default;
Document& Document::operator=(Document&&) noexcept = default;
Document::~Document() = default;

Result<Document> Document::parse(std::string_view text, std::string name, const std::vector<std::string>& overrides) {
  if (text.size() > kMaxFileBytes) {
    return fail(Errc::kTooLarge, name + ": larger than 4 MiB");
  }
  auto impl = std::make_unique<Impl>();
  impl->name = std::move(name);
  if (const Status ok = guard_yaml(text, impl->name); !ok) {
    return tl::unexpected<Error>(ok.error());
  }
  try {
    impl->root = YAML::Load(std::string(text));
  } catch (const YAML::Exception& error) {
    return fail(Errc::kParse, impl->name + ":" + std::to_string(error.mark.line + 1) + ": " + error.msg);
  }
  if (impl->root.IsNull()) {
    impl->root = YAML::Node(YAML::NodeType::Map);
  }
  if (!impl->root.IsMap()) {
    return fail(Errc::kParse, impl->name + ": expected key: value lines at the top");
  }
  for (const std::string& assignment : overrides) {
    if (const Status ok = apply_override(impl->root, assignment); !ok) {
      return tl::unexpected<Error>(ok.error());
    }
  }
  impl->overrides = overrides;
  return Document(std::move(impl));
}

}  // namespace seeker::config
