/// \file
/// Who commanded what in one session: commands wait for their outcome, and rows of equal ones become two records.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "common/api/audit.hpp"
#include "common/api/robot_api.hpp"
#include "common/pki/certificate.hpp"
#include "common/wire/audit_rows.hpp"
#include "common/wire/liveness.hpp"
#include "seeker/v1/calls.pb.h"

namespace seeker::server_net {

/// The clocks that a record needs.
struct AuditClocks {
  std::int64_t unix_ns = 0;
  RobotTime robot;
  wire::WallTime wall;
};

/// `drive` commands of one outcome are a row (wire::AuditRows) at any velocity; other commands are where they
/// ask for the same; those that the session has refused by itself (role, rate) are one for any of them.
class SessionAudit {
 public:
  using Sink = wire::AuditRows::Sink;

  /// `certificate` may be null: plain TCP.
  SessionAudit(Sink sink, std::string address, const pki::CertificateFacts* certificate);

  /// A request that is being carried out; requests that change nothing are left out.
  void asked(const seeker::v1::Request& request, const api::Caller& caller, const AuditClocks& now);
  /// Its response.
  void answered(const seeker::v1::Response& response, const AuditClocks& now);
  /// A request that the session has refused, with its response.
  void refused(const seeker::v1::Request& request, const seeker::v1::Response& response, const api::Caller& caller,
               const AuditClocks& now);
  /// To be called about once per second.
  void tick(wire::WallTime now) { rows_.tick(now); }
  /// The session ends: commands without an answer have the outcome "unknown", since the robot may or may not have
  /// carried them out.
  void end(const AuditClocks& now);

 private:
  [[nodiscard]] api::AuditRecord record_of(const seeker::v1::Request& request, std::string essentials,
                                           const api::Caller& caller, const AuditClocks& now) const;

  api::AuditRecord base_;                                   ///< what all records of the session have in common
  std::multimap<std::uint64_t, api::AuditRecord> waiting_;  ///< by request id, which a client may use twice
  wire::AuditRows rows_;
};

}  // namespace seeker::server_net
