/// \file
/// Declarations that the source files of Store share.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "server/store/database.hpp"
#include "server/store/store.hpp"

namespace seeker::store {

struct Store::Body {
  Database database;
  std::string lost;  ///< see lost()
};

/// Checks the size of a blob. kTooLarge above kMaxBlob_bytes; `what` begins the message.
[[nodiscard]] Status check_blob(const char* what, const Blob& blob);
/// Checks the sizes of texts. kTooLarge above kMaxText_bytes.
[[nodiscard]] Status check_texts(std::initializer_list<std::string_view> texts);
/// Checks an id. kInvalidArgument when it is empty.
[[nodiscard]] Status check_id(const char* what, const std::string& id);

/// Runs `statement` to its end and collects what `read` makes of each row.
template <class Read>
[[nodiscard]] auto collect(Result<Statement>& statement, Read read) -> Result<std::vector<decltype(read(*statement))>> {
  std::vector<decltype(read(*statement))> rows;
  for (;;) {
    const Result<bool> row = statement->step();
    if (!row) {
      return tl::unexpected(row.error());
    }
    if (!*row) {
      return rows;
    }
    rows.push_back(read(*statement));
  }
}

}  // namespace seeker::store
