/// \file
/// Expected failures as values. A bug asserts (see assert.hpp); "nothing yet" is std::optional; everything a
/// peer, a file, a sensor or a user can cause is a Result whose error names cause and remedy.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include <tl/expected.hpp>

namespace seeker {

/// Kind of an expected failure: what a caller may branch on. The message is for people and is never parsed.
enum class Errc : std::uint8_t {
  kInvalidArgument,     ///< a value is outside what is allowed
  kParse,               ///< text or bytes do not follow their format
  kNotFound,            ///< no such file, component, mission, target
  kUnsupportedVersion,  ///< the other side or the file is newer than this program
  kCorrupt,             ///< checksum or structure shows that data were damaged
  kIo,                  ///< the operating system refused to read or write
  kTimeout,             ///< no answer in time
  kCancelled,           ///< stopped on request
  kRefused,             ///< the robot does not allow it (lease, emergency stop, safety)
  kBusy,                ///< another mission or owner is active
  kNotReady,            ///< not in a state to do this yet
  kLinkLost,            ///< no connection, or it broke
  kTooLarge,            ///< over a stated limit
  kUnreachable,         ///< no path leads to the goal
  kInternal,            ///< a fault on the other side
};

/// Stable lower-case name of a code, as printed in JSON and logs.
[[nodiscard]] std::string_view to_string(Errc code);

/// One failure: a code to branch on and one sentence naming cause and remedy.
struct Error {
  Errc code = Errc::kInternal;
  std::string message;

  friend bool operator==(const Error&, const Error&) = default;
};

/// A failure in two sentences, as faults show it.
struct CauseAndRemedy {
  std::string cause;
  std::string remedy;  ///< empty: the message names none
};

/// The sentence of an error, apart by its last semicolon.
[[nodiscard]] CauseAndRemedy cause_and_remedy(const Error& error);

template <class T>
using Result = tl::expected<T, Error>;

/// Outcome of an operation without a value.
using Status = Result<void>;

/// Shorthand for returning a failure: `return fail(Errc::kNotFound, "...")`.
[[nodiscard]] inline tl::unexpected<Error> fail(Errc code, std::string message) {
  return tl::unexpected<Error>(Error{code, std::move(message)});
}

/// The same error with more context in front of its sentence (a file, a component).
[[nodiscard]] inline tl::unexpected<Error> fail_with_context(std::string_view context, const Error& cause) {
  return tl::unexpected<Error>(Error{cause.code, std::string(context) + ": " + cause.message});
}

}  // namespace seeker
