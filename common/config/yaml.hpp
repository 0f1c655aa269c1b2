/// \file
/// Strict YAML: an unknown, repeated or mistyped key is an error with file, line, path and what is allowed. Anchors and
/// aliases are refused (a short file could otherwise expand without bound).
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/config/fields.hpp"
#include "common/core/result.hpp"

namespace seeker::config {

/// Largest file read.
inline constexpr std::size_t kMaxFileBytes = std::size_t{4} << 20U;

/// One parsed document, from which structs are read.
class Document {
 public:
  /// `name` is used in messages. `overrides` are "a.b.c=value" and win over the text.
  [[nodiscard]] static Result<Document> parse(std::string_view text, std::string name,
                                              const std::vector<std::string>& overrides = {});
  [[nodiscard]] static Result<Document> load(const std::filesystem::path& path,
                                             const std::vector<std::string>& overrides = {});
  Document(Document&&) noexcept;
  Document& operator=(Document&&) noexcept;
  ~Document();

  /// Fills `value` through describe(); a key of the document that describe() does not name is an error.
  template <class T>
  [[nodiscard]] Status read(T& value) const {
    Session session(*this);
    describe(session.fields(), value);
    return session.finish();
  }

 private:
  struct Impl;
  class Reader;

  /// One pass over the document.
  class Session {
   public:
    explicit Session(const Document& document);
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;
    ~Session();
    [[nodiscard]] Fields& fields();
    [[nodiscard]] Status finish();

   private:
    std::unique_ptr<Reader> reader_;
  };

  explicit Document(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// Reads a file into `value`, whose present content are the defaults.
template <class T>
[[nodiscard]] Status load_file(const std::filesystem::path& path, T& value,
                               const std::vector<std::string>& overrides = {}) {
  const Result<Document> document = Document::load(path, overrides);
  if (!document) {
    return tl::unexpected<Error>(document.error());
  }
  return document->read(value);
}

/// The bytes of a text file, at most kMaxFileBytes.
[[nodiscard]] Result<std::string> read_text_file(const std::filesystem::path& path);

/// Turns the effective values into texts, each as it stands in a file.
class TextFields : public Fields {
 public:
  void field(std::string_view key, double& value) override;
  void field(std::string_view key, int& value) override;
  void field(std::string_view key, std::uint64_t& value) override;
  void field(std::string_view key, bool& value) override;
  void field(std::string_view key, std::string& value) override;
  void field(std::string_view key, std::vector<double>& value) override;
  void field(std::string_view key, std::vector<std::string>& value) override;
  void field(std::string_view key, Point2& value) override;
  void field(std::string_view key, Polygon& value) override;
  void field(std::string_view key, Pose2& value) override;
  void require(std::string_view /*key*/) override {}
  void check(std::string_view /*key*/, bool /*ok*/, std::string_view /*message*/) override {}
  [[nodiscard]] bool has(std::string_view /*key*/) const override { return false; }
  [[nodiscard]] bool reading() const override { return false; }

 protected:
  virtual void line(std::string_view key, const std::string& value) = 0;
  void refuse_choice(std::string_view /*key*/, const std::string& /*got*/,
                     const std::vector<std::string_view>& /*allowed*/) override {}
};

/// Collects the effective values as YAML text.
class Printer final : public TextFields {
 public:
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  [[nodiscard]] bool enter(std::string_view key) override;
  [[nodiscard]] std::optional<std::size_t> enter_list(std::string_view key, std::size_t size) override;
  void enter_item(std::size_t index) override;
  void leave() override;
  void line(std::string_view key, const std::string& value) override;

  std::string text_;
  int depth_ = 0;
  bool item_start_ = false;
};

/// One effective value and its path in a file: "a.b.c".
struct Leaf {
  std::string path;
  std::string value;

  friend bool operator==(const Leaf&, const Leaf&) = default;
};

/// Collects the effective values with their paths; lists of sections are left out.
class LeafCollector final : public TextFields {
 public:
  [[nodiscard]] std::vector<Leaf>& leaves() { return leaves_; }

 private:
  [[nodiscard]] bool enter(std::string_view key) override;
  [[nodiscard]] std::optional<std::size_t> enter_list(std::string_view /*key*/, std::size_t /*size*/) override {
    return std::nullopt;
  }
  void enter_item(std::size_t /*index*/) override {}
  void leave() override;
  void line(std::string_view key, const std::string& value) override;

  std::vector<Leaf> leaves_;
  std::vector<std::string> sections_;
};

/// The effective values of a struct as YAML.
template <class T>
[[nodiscard]] std::string print(T value) {
  Printer printer;
  describe(printer, value);
  return printer.text();
}

/// The effective values of a struct, each with its path.
template <class T>
[[nodiscard]] std::vector<Leaf> leaves_of(T value) {
  LeafCollector collector;
  describe(collector, value);
  return std::move(collector.leaves());
}

}  // namespace seeker::config
