#!/usr/bin/env bash
# clang-tidy over every source of the preset dev but the tests, which the compiler's warnings and their own runs check. A file
# that was clean is not checked again until it, a header of ours that it includes, its compile command, a .proto or .clang-tidy
# changes. With "deep" as argument the analyzer follows calls, and passing by value is judged, for which clang-tidy walks the whole
# source once for each parameter: several times as long.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/lint/sources.sh

readonly database=build/dev/compile_commands.json
readonly cache=build/lint-cache
readonly batch_files=60
mkdir -p "$cache"
[[ -e $database ]] || { echo "no $database: configure first (cmake --preset dev)" >&2; exit 2; }

analyzer_mode=${1:-shallow}
left_out=
[[ $analyzer_mode == deep ]] || left_out=-performance-unnecessary-value-param
salt=$( (clang-tidy --version; cat .clang-tidy; echo "$analyzer_mode $left_out") | sha256sum)
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

# The compile flags of FILE in the database, a line each, without compiler, output and source.
flags_of() {
  local words i
  read -ra words < <(grep -F '"command":' "$database" | grep -F -- " -c $PWD/$1\"" | head -1 |
    sed 's/.*"command": "//; s/",\?$//; s/\\//g')
  for ((i = 0; i < ${#words[@]}; ++i)); do
    case ${words[i]} in
      */c++ | */g++* | */ccache) ;;
      -o | -c) i=$((i + 1)) ;;
      *) printf '%s\n' "${words[i]}" ;;
    esac
  done
}

# tidy FILE FLAGS_OF...: findings and exit code of clang-tidy on FILE, compiled with all flags of the others.
tidy() {
  local flags other
  mapfile -t flags < <(for other in "${@:2}"; do flags_of "$other"; done |
    awk '$0 == "-isystem" {getline path; $0 = "-isystem" path} !seen[$0]++')
  clang-tidy --quiet --config-file=.clang-tidy --checks="$left_out" --extra-arg=-Wno-unknown-warning-option "$1" -- \
    "${flags[@]}" -Xclang -analyzer-config -Xclang "mode=$analyzer_mode" 2>&1
}

# check_batch "FILE KEY" ...: most of the time of one file goes into the headers, so that files are checked many at a time, and
# halved where that finds something: names may clash that never meet. What a file alone shows is what counts.
check_batch() {
  local pair half=$(($# / 2)) failed=0 output
  if (($# == 1)); then
    if output=$(tidy "${1% *}" "${1% *}"); then
      touch "$cache/${1##* }"
    else
      grep -v 'warnings generated\|Suppressed .* warnings\|Use -header-filter' <<<"$output"
      return 1
    fi
    return
  fi
  local joined
  joined=$(mktemp --suffix=.cpp)
  for pair in "$@"; do cat "${pair% *}"; done >"$joined"
  if tidy "$joined" "${@% *}" >/dev/null; then
    for pair in "$@"; do touch "$cache/${pair##* }"; done
  else
    check_batch "${@:1:half}" || failed=1
    check_batch "${@:half+1}" || failed=1
  fi
  rm -f "$joined"
  return "$failed"
}

# check_line LINE: the batch that `batches` printed.
check_line() {
  local pairs
  IFS=$'\t' read -ra pairs <<<"$1"
  check_batch "${pairs[@]}"
}
export -f flags_of tidy check_batch check_line
export database cache analyzer_mode left_out

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
alone=$(grep -oE '(common|server|client)/[a-z0-9_/]+\.cpp' cmake/SeekerUnity.cmake | tr '\n' ' ')
sort "$work" | awk -v most="$batch_files" -v alone="$alone" -f tests/lint/batches.awk |
  xargs -r -d '\n' -n 1 -P "${JOBS:-2}" bash -c 'check_line "$1"' check
