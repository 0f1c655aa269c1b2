/// \file
/// Command lines of the project's programs in the code of a page.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace seeker::docs {

struct Command {
  std::string program;             ///< seeker, seekerd, seeker-emulator, seeker-lab or run
  std::vector<std::string> words;  ///< its arguments; brackets of what may be left out are gone
};

/// The commands in a line of code, without comments; a program may be named with its folder. Commands may be joined by
/// `|`, `&&` or `;` between spaces. Code that begins with another word holds none.
[[nodiscard]] std::vector<Command> commands_in(std::string_view code);

/// Whether a word stands for what the reader fills in: NAME, FILE.png, X,Y, or three dots.
[[nodiscard]] bool is_placeholder(std::string_view word);

}  // namespace seeker::docs
