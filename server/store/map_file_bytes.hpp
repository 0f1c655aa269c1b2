/// \file
/// Little-endian bytes of map files; every count is checked when it is read.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "common/core/pose2.hpp"
#include "common/core/time.hpp"

namespace seeker::store {

/// CRC-32 (IEEE 802.3, reflected): finds every single flipped bit and every burst of up to 32 bits.
[[nodiscard]] std::uint32_t crc32(std::span<const std::uint8_t> bytes);

class ByteWriter {
 public:
  template <class T>
  requires std::is_arithmetic_v<T>
  void put(T value) {
    if constexpr (std::is_same_v<T, double>) {
      put(std::bit_cast<std::uint64_t>(value));
    } else if constexpr (std::is_same_v<T, float>) {
      put(std::bit_cast<std::uint32_t>(value));
    } else {
      using Unsigned = std::make_unsigned_t<T>;
      auto rest = static_cast<Unsigned>(value);
      std::array<std::uint8_t, sizeof(T)> little{};
      for (std::uint8_t& byte : little) {
        byte = static_cast<std::uint8_t>(rest & Unsigned{0xFF});
        rest = static_cast<Unsigned>(static_cast<std::uint64_t>(rest) >> 8U);
      }
      bytes_.insert(bytes_.end(), little.begin(), little.end());
    }
  }
  void put(const std::string& text) {
    put(static_cast<std::uint16_t>(text.size()));
    bytes_.insert(bytes_.end(), text.begin(), text.end());
  }
  void put(const Pose2& pose) {
    put(pose.x_m);
    put(pose.y_m);
    put(pose.theta_rad);
  }
  void put(RobotTime time) { put(static_cast<std::int64_t>(time.time_since_epoch().count())); }
  void put(const Matrix2& matrix) { put_rows(matrix); }
  void put(const Matrix3& matrix) { put_rows(matrix); }
  void put(std::span<const std::uint8_t> bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }

  [[nodiscard]] const std::vector<std::uint8_t>& bytes() const { return bytes_; }
  [[nodiscard]] std::vector<std::uint8_t> take() { return std::move(bytes_); }
  void reserve(std::size_t bytes) { bytes_.reserve(bytes); }

 private:
  template <class M>
  void put_rows(const M& matrix) {
    for (int row = 0; row < matrix.rows(); ++row) {
      for (int column = 0; column < matrix.cols(); ++column) {
        put(matrix(row, column));
      }
    }
  }

  std::vector<std::uint8_t> bytes_;
};

/// Reads values in order. After the first missing byte all values read as zero and ok() is false.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] std::size_t left() const { return rest_.size(); }

  template <class T>
  requires std::is_arithmetic_v<T>
  void get(T& value) {
    if constexpr (std::is_same_v<T, double>) {
      std::uint64_t bits = 0;
      get(bits);
      value = std::bit_cast<double>(bits);
    } else if constexpr (std::is_same_v<T, float>) {
      std::uint32_t bits = 0;
      get(bits);
      value = std::bit_cast<float>(bits);
    } else {
      std::uint64_t bits = 0;
      const std::span<const std::uint8_t> little = take(sizeof(T));
      for (std::size_t k = little.size(); k > 0; --k) {
        bits = (bits << 8U) | little[k - 1];
      }
      value = static_cast<T>(bits);
    }
  }
  void get(std::string& text) {
    std::uint16_t size = 0;
    get(size);
    const std::span<const std::uint8_t> bytes = take(size);
    text.assign(bytes.begin(), bytes.end());
  }
  void get(Pose2& pose) {
    get(pose.x_m);
    get(pose.y_m);
    get(pose.theta_rad);
  }
  void get(RobotTime& time) {
    std::int64_t ns = 0;
    get(ns);
    time = RobotTime(Duration(ns));
  }
  void get(Matrix2& matrix) { get_rows(matrix); }
  void get(Matrix3& matrix) { get_rows(matrix); }
  /// Reads one byte that is 0 or 1.
  void get_flag(bool& flag) {
    std::uint8_t byte = 0;
    get(byte);
    ok_ = ok_ && byte <= 1;
    flag = byte == 1;
  }
  /// Reads a number of entries of at least `entry_bytes` each; more than the remaining bytes can hold is refused.
  [[nodiscard]] std::size_t get_count(std::size_t entry_bytes) {
    std::uint32_t count = 0;
    get(count);
    ok_ = ok_ && count <= left() / entry_bytes;
    return ok_ ? count : 0;
  }
  /// Takes the next `size` bytes; an empty span when fewer remain.
  [[nodiscard]] std::span<const std::uint8_t> take(std::size_t size) {
    ok_ = ok_ && size <= rest_.size();
    if (!ok_) {
      return {};
    }
    const std::span<const std::uint8_t> bytes = rest_.first(size);
    rest_ = rest_.subspan(size);
    return bytes;
  }

 private:
  template <class M>
  void get_rows(M& matrix) {
    for (int row = 0; row < matrix.rows(); ++row) {
      for (int column = 0; column < matrix.cols(); ++column) {
        get(matrix(row, column));
      }
    }
  }

  std::span<const std::uint8_t> rest_;
  bool ok_ = true;
};

}  // namespace seeker::store
