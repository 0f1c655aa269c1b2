# Makes a completion for bash of what collect.sh prints: verbs, options and the words that an option may take.
# Variable: program.

function add(word) { words[verb] = words[verb] (words[verb] == "" ? "" : " ") word }

function take(option_of_verb, choices) { options[++count_of_options] = option_of_verb; values[option_of_verb] = choices }

function words_of(choices) { return choices == kFiles ? "-f" : "-W '" choices "'" }

BEGIN { kFiles = "FILES" }

# The names in "-o,--option TEXT:{a,b}", and the words in the braces.
function option(text,   names, count, i, choices) {
  choices = ""
  if (text ~ /^[-a-z,]+ TEXT/) choices = kFiles
  if (match(text, /\{[^}]*\}/)) {
    choices = substr(text, RSTART + 1, RLENGTH - 2)
    gsub(/,/, " ", choices)
  }
  sub(/[ :=\[].*/, "", text)
  count = split(text, names, ",")
  for (i = 1; i <= count; i++) {
    add(names[i])
    if (choices != "") take((verb == "" ? "" : verb " ") names[i], choices)
  }
}

/^@ / { verb = substr($0, 3); order[++verbs] = verb; words[verb] = ""; section = ""; next }
/^[^ ]/ { section = $0; next }
section == "Subcommands:" && /^  [a-z]/ { add($1) }
section == "Options:" && /^  -/ { option(substr($0, 3)) }

END {
  name = program
  gsub(/-/, "_", name)
  print "# bash completion for " program
  print "_" name "() {"
  print "  local current=\"${COMP_WORDS[COMP_CWORD]}\" previous=\"${COMP_WORDS[COMP_CWORD-1]}\" verb='' next words i"
  print "  COMPREPLY=()"
  print "  for ((i = 1; i < COMP_CWORD; i++)); do"
  print "    next=\"${verb:+$verb }${COMP_WORDS[i]}\""
  print "    case \"$next\" in"
  for (i = 1; i <= verbs; i++) if (order[i] != "") print "    '" order[i] "') verb=\"$next\" ;;"
  print "    esac"
  print "  done"
  print "  case \"${verb:+$verb }$previous\" in"
  for (i = 1; i <= count_of_options; i++) {
    print "    '" options[i] "') mapfile -t COMPREPLY < <(compgen " words_of(values[options[i]]) " -- \"$current\"); return ;;"
  }
  print "  esac"
  print "  case \"$verb\" in"
  for (i = 1; i <= verbs; i++) print "    '" order[i] "') words='" words[order[i]] "' ;;"
  print "  esac"
  print "  mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$current\")"
  print "  ((${#COMPREPLY[@]} > 0)) || mapfile -t COMPREPLY < <(compgen -f -- \"$current\")"
  print "}"
  print "complete -o filenames -F _" name " " program
}
