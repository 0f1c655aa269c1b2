#!/usr/bin/env bash
# collect.sh PROGRAM: what PROGRAM and each of its verbs print for --help, each behind a line "@ VERB WORDS". Read by
# man_page.awk and completion.awk.
set -euo pipefail

program=$1

# The verbs that a help text lists.
verbs_in() {
  awk '/^[^ ]/ { listed = $0 == "Subcommands:" } listed && /^  [a-z]/ { print $1 }'
}

# collect [VERB...]
collect() {
  local help verb
  help=$("$program" "$@" --help </dev/null)
  printf '@ %s\n%s\n' "$*" "$help"
  for verb in $(verbs_in <<<"$help"); do
    collect "$@" "$verb"
  done
}

collect
