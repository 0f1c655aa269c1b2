#!/usr/bin/env bash
# clang-tidy over every source of the preset dev but the tests, which the compiler's warnings and their own runs check. A file that was clean is not checked again until it, a header of ours
# that it includes, its compile command, a .proto or .clang-tidy changes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/lint/sources.sh

readonly database=build/dev/compile_commands.json
readonly cache=build/lint-cache
mkdir -p "$cache"
[[ -e $database ]] || { echo "no $database: configure first (cmake --preset dev)" >&2; exit 2; }

salt=$( (clang-tidy --version; cat .clang-tidy) | sha256sum)
mapfile -t protos < <(sources proto)

mapfile -t code < <(sources cpp hpp)

# "FILE <tab> header header ..." for each source of the database: all headers of ours, however deep.
closures() {
  awk -v top="$PWD/" '
    FILENAME == ARGV[1] {
      if ($1 == "\"file\":") { f = $2; gsub(/[",]/, "", f); if (index(f, top) == 1) { f = substr(f, length(top) + 1)
          if (f !~ /^(build|tests)\//) unit[++units] = f } }
      next
    }
    match($0, /^[ \t]*#[ \t]*include[ \t]*["<][^">]+/) {
      h = substr($0, RSTART, RLENGTH); sub(/.*["<]/, "", h); edges[FILENAME] = edges[FILENAME] " " h
    }
    { ours[FILENAME] = 1 }
    function add(file,   list, n, i) {
      n = split(edges[file], list, " ")
      for (i = 1; i <= n; ++i) {
        if (list[i] ~ /\.pb\.h$/) list[i] = "PROTO"
        if ((list[i] in ours || list[i] == "PROTO") && !(list[i] in seen)) { seen[list[i]] = 1; add(list[i]) }
      }
    }
    END {
      for (u = 1; u <= units; ++u) {
        delete seen; add(unit[u]); line = unit[u] "\t"
        for (h in seen) line = line h " "
        print line
      }
    }' "$database" "${code[@]}"
}

check_one() {
  local file=$1 key=$2 output
  if output=$(clang-tidy -p build/dev --quiet --extra-arg=-Wno-unknown-warning-option "$file" 2>&1); then
    touch "build/lint-cache/$key"
  else
    grep -v 'warnings generated\|Suppressed .* warnings\|Use -header-filter' <<<"$output"
    return 1
  fi
}
export -f check_one

work=$(mktemp)
trap 'rm -f "$work"' EXIT
total=0
while IFS=$'\t' read -r file headers; do
  total=$((total + 1))
  read -ra files <<<"${headers//PROTO/${protos[*]-}}"
  mapfile -t files < <(printf '%s\n' "${files[@]-}" | sort -u | grep . || true)
  key=$( (echo "$salt"; grep -F "\"command\":" "$database" | grep -F -- "$file" || true
          sha256sum "$file" "${files[@]}") | sha256sum | cut -d' ' -f1)
  [[ -e $cache/$key ]] || echo "$file $key" >>"$work"
done < <(closures)

echo "clang-tidy: $(wc -l <"$work") of $total files to check"
xargs -r -P "${JOBS:-2}" -L 1 bash -c 'check_one "$@"' check <"$work"
