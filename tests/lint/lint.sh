#!/usr/bin/env bash
# Everything that ./run lint checks; with "deep" as argument clang's analyzer follows calls. Goes on after a failure, so that
# one call shows all there is.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.." || exit
source tests/lint/sources.sh
code=0

step() {
  echo "== $1"
  shift
  "$@" || { code=1; echo "FAILED: $*"; }
}

check_format() { sources cpp hpp | xargs -d '\n' -r clang-format --dry-run -Werror; }

check_scripts() {
  local script
  local scripts=(run .ci/run)
  mapfile -t -O 2 scripts < <(sources sh)
  for script in "${scripts[@]}"; do
    bash -n "$script" || return 1
  done
  if command -v shellcheck >/dev/null; then
    shellcheck --severity=warning --shell=bash "${scripts[@]}"
  fi
}

step "format" check_format
step "scripts" check_scripts
step "rules" tests/lint/rules.sh
step "words" tests/lint/words.sh
step "clang-tidy" tests/lint/tidy.sh "${1:-shallow}"
((code == 0)) && echo "lint: clean"
exit "$code"
