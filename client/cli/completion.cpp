#include <algorithm>

#include "client/cli/command_line.hpp"

namespace seeker::cli {
namespace {

/// Calls visit(path, node) for the command and everything below; the path is "" for the program, "map export" for a
/// leaf.
template <class Visit>
void for_each_command(const CommandTree& tree, const std::string& path, Visit visit) {
  visit(path, tree);
  for (const CommandTree& command : tree.commands) {
    for_each_command(command, path.empty() ? command.name : path + " " + command.name, visit);
  }
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) {
    text += (text.empty() ? "" : " ") + word;
  }
  return text;
}

std::string words_after(const CommandTree& node, const CommandTree& root) {
  std::vector<std::string> words;
  for (const CommandTree& command : node.commands) {
    words.push_back(command.name);
  }
  words.insert(words.end(), node.words.begin(), node.words.end());
  for (const CommandTree* tree : {&node, &root}) {
    for (const CommandTree::Option& option : tree->options) {
      for (const std::string& name : option.names) {
        if (std::find(words.begin(), words.end(), name) == words.end()) {
          words.push_back(name);
        }
      }
    }
    if (&node == &root) {
      break;
    }
  }
  return joined(words);
}

std::string single_quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) {
    out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return out + "'";
}

/// The function shared by bash and zsh (through bashcompinit).
std::string bash_script(const CommandTree& root) {
  std::string values;
  std::string words;
  std::string paths;
  for_each_command(root, "", [&](const std::string& path, const CommandTree& node) {
    words += "    " + single_quoted(path) + ") words=" + single_quoted(words_after(node, root)) + " ;;\n";
    if (!path.empty()) {
      paths += (paths.empty() ? "" : "|") + single_quoted(path);
    }
    for (const CommandTree::Option& option : node.options) {
      for (const std::string& name : option.names) {
        if (!option.values.empty()) {
          values += "    " + single_quoted((path.empty() ? "" : path + " ") + name) + ") COMPREPLY=($(compgen -W " +
                    single_quoted(joined(option.values)) + " -- \"$current\")); return ;;\n";
        }
      }
    }
  });
  return "_seeker() {\n"
         "  local current=\"${COMP_WORDS[COMP_CWORD]}\" previous=\"${COMP_WORDS[COMP_CWORD-1]}\" path='' next words i\n"
         "  COMPREPLY=()\n"
         "  for ((i = 1; i < COMP_CWORD; i++)); do\n"
         "    next=\"${path:+$path }${COMP_WORDS[i]}\"\n"
         "    case \"$next\" in\n    " +
         paths +
         ") path=\"$next\" ;;\n    esac\n"
         "  done\n"
         "  case \"${path:+$path }$previous\" in\n" +
         values +
         "  esac\n"
         "  case \"$path\" in\n" +
         words +
         "  esac\n"
         "  COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
         "  [[ ${#COMPREPLY[@]} -eq 0 ]] && COMPREPLY=($(compgen -f -- \"$current\"))\n"
         "}\n"
         "complete -o filenames -F _seeker seeker\n";
}

std::string fish_option(const CommandTree::Option& option, const std::string& condition) {
  std::string line = "complete -c seeker";
  if (!condition.empty()) {
    line += " -n " + single_quoted(condition);
  }
  for (const std::string& name : option.names) {
    line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  if (option.takes_value) {
    line += option.values.empty() ? " -r" : " -x -a " + single_quoted(joined(option.values));
  }
  return line + " -d " + single_quoted(option.description) + "\n";
}

std::string fish_script(const CommandTree& root) {
  std::string text;
  for_each_command(root, "", [&](const std::string& path, const CommandTree& node) {
    const std::string last = path.substr(path.rfind(' ') == std::string::npos ? 0 : path.rfind(' ') + 1);
    const std::string condition = path.empty() ? "" : "__fish_seen_subcommand_from " + last;
    for (const CommandTree& command : node.commands) {
      text += "complete -c seeker -f -n " + single_quoted(path.empty() ? "__fish_use_subcommand" : condition) + " -a " +
              command.name + " -d " + single_quoted(command.description) + "\n";
    }
    if (!node.words.empty()) {
      text +=
          "complete -c seeker -f -n " + single_quoted(condition) + " -a " + single_quoted(joined(node.words)) + "\n";
    }
    for (const CommandTree::Option& option : node.options) {
      text += fish_option(option, condition);
    }
  });
  return text;
}

}  // namespace

Result<std::string> completion_script(const std::string& shell) {
  const CommandTree root = command_tree();
  if (shell == "bash") {
    return "# bash completion for seeker\n" + bash_script(root);
  }
  if (shell == "zsh") {
    return "#compdef seeker\nautoload -U +X bashcompinit && bashcompinit\n" + bash_script(root);
  }
  if (shell == "fish") {
    return "# fish completion for seeker\n" + fish_script(root);
  }
  return fail(Errc::kInvalidArgument, "no completion for '" + shell + "'; choose bash, zsh or fish");
}

}  // namespace seeker::cli
