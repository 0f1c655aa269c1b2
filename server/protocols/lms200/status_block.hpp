/// \file
/// The long report of the LMS200 on its state (protocols 2.5).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/core/result.hpp"
#include "server/protocols/lms200/measuring.hpp"

namespace seeker::lms200 {

/// The fields that are used; the others are zero when written, and ignored when read.
struct StatusBlock {
  static constexpr std::size_t kVersionChars = 7;

  std::string software_version;  ///< kVersionChars characters, padded with spaces
  std::string prom_version;      ///< likewise
  std::uint8_t operating_mode = 0;
  bool defective = false;  ///< the device found an error of its own; the error list says which
  std::uint8_t variant_code = 0;
  std::array<std::uint16_t, 8> pollution{};              ///< each sector of the window now
  std::array<std::uint16_t, 4> reference_pollution{};    ///< its reference channels now
  std::array<std::uint16_t, 8> pollution_calibration{};  ///< the same with a clean window
  std::array<std::uint16_t, 4> reference_calibration{};
  std::uint16_t mirror_rotations = 0;
  std::uint8_t measuring_mode = 0;  ///< code of a MeasuringMode
  Variant variant;
  std::uint8_t restart_mode = 0;
  std::uint16_t restart_time = 0;
  std::uint16_t baud_word = 0;  ///< see baud_word()
  bool permanent_baud = false;  ///< the rate outlives a power cycle
  std::uint8_t address = 0;
  std::uint8_t field_set = 0;
  std::uint8_t unit = 0;  ///< code of a Unit
  bool laser_on = true;

  friend bool operator==(const StatusBlock&, const StatusBlock&) = default;
};

/// The payload from the response byte 0xB1 to the status byte, which is given: 152 bytes.
[[nodiscard]] std::vector<std::uint8_t> encode(const StatusBlock& block, std::uint8_t status);
/// Reads the payload of a response 0xB1. kParse: it is too short.
[[nodiscard]] Result<StatusBlock> decode_status_block(std::span<const std::uint8_t> payload);

}  // namespace seeker::lms200
