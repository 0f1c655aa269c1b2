#!/usr/bin/env bash
# Rules that neither the compiler nor clang-tidy know. Prints every breach as file:line and fails if there is one.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/lint/sources.sh

readonly MAX_LINES=400
found=0

# report RULE < breaches
report() {
  local breaches
  breaches=$(cat)
  if [[ -n $breaches ]]; then
    printf '%s:\n%s\n' "$1" "$breaches"
    found=1
  fi
}

mapfile -t code < <(sources cpp hpp)
mapfile -t all < <(sources cpp hpp proto txt cmake yaml fll md sh json awk | grep -v '^tests/lint/')

# g++ 12 destroys the captures twice. [^;{}] keeps the match inside one expression.
report "a lambda with a capture inside a co_await expression (use a named coroutine function)" < <(
  for file in "${code[@]}"; do
    grep -Pzo '(?s)co_await[^;{}]*(?<![\w\])])\[[&=\w][^\]]*\]\s*(\(|mutable\b|\{)' "$file" 2>/dev/null |
      tr '\0' '\n' | grep -n 'co_await' | sed "s|^[0-9]*|$file|" || true
  done
)
report "unfinished work" < <(grep -nE '\b(TODO|FIXME|XXX)\b' "${all[@]}" run .ci/run || true)
report "typedef (write using)" < <(grep -nE '^[[:space:]]*typedef ' "${code[@]}" || true)
report "a path of one machine" < <(grep -nE '(^|[^[:alnum:]_.~-])/(home|root|work|Users)/' "${all[@]}" run .ci/run || true)
# tests/lint/long_files.txt: the exceptions, one path a line with the reason behind it.
report "more than $MAX_LINES lines (split the file, or list it with a reason in tests/lint/long_files.txt)" < <(
  for file in "${code[@]}"; do
    lines=$(wc -l <"$file")
    if ((lines > MAX_LINES)) && ! grep -q "^$file " tests/lint/long_files.txt; then
      echo "$file: $lines lines"
    fi
  done
)
exit "$found"
