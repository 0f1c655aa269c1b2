/// \file
/// Who commanded what: one record for each call that changes something, or was refused.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "common/core/time.hpp"

namespace seeker::api {

// Longest texts of a record in bytes, so that a bounded number of records has a bounded size.
inline constexpr std::size_t kMaxAuditEssentials_bytes = 160;
inline constexpr std::size_t kMaxAuditMessage_bytes = 200;
/// Most records of one answer.
inline constexpr std::uint32_t kMaxAuditRecords = 10'000;

struct AuditRecord {
  std::uint64_t number = 0;  ///< from 1 in the order in which records were kept; 0: not kept yet
  std::int64_t unix_ns = 0;  ///< wall clock of the robot when the call arrived, since 1970, UTC
  RobotTime stamp;           ///< robot time when the call arrived
  std::string client;        ///< by which the robot knows it; empty at the fleet's port without certificates
  std::string role;          ///< granted in the session: "observer", "operator", "admin"; empty without one
  std::string certificate;   ///< name in it; empty: plain TCP
  std::string serial;        ///< of the certificate, lower-case hexadecimal
  std::string address;       ///< of the other end, "10.0.0.7:51234"
  std::string call;          ///< "start_mission"
  std::string essentials;    ///< what was asked for, at most kMaxAuditEssentials_bytes
  std::string outcome;       ///< "ok", or the name of the error code, as "refused"; "unknown": the session ended first
  std::string message;       ///< of the error, at most kMaxAuditMessage_bytes

  friend bool operator==(const AuditRecord&, const AuditRecord&) = default;
};

/// Which records are wanted.
struct AuditQuery {
  std::uint32_t last = 0;  ///< the newest ones, 1 to kMaxAuditRecords
  std::string client;      ///< of this client alone, or of those named "CLIENT/..."; empty: of all

  friend bool operator==(const AuditQuery&, const AuditQuery&) = default;
};

}  // namespace seeker::api
