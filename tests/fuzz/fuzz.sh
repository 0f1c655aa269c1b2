#!/usr/bin/env bash
# Runs the fuzz targets. Called by ./run fuzz.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

usage() {
  cat <<'TEXT'
./run fuzz [TARGET...] [--minutes N] [--jobs N]: each target (default: all) for N minutes (default 1), two at a time.
Starts from tests/fuzz/corpus/TARGET; what it learns stays in build/fuzz/corpus/TARGET, findings in build/fuzz/findings.
A finding fails the run; add it to tests/fuzz/corpus/TARGET together with the fix.
TEXT
}

minutes=1
jobs=2
targets=()
while (($# > 0)); do
  case $1 in
    --help) usage; exit 0 ;;
    --minutes) minutes=${2:?--minutes needs a number}; shift ;;
    --jobs) jobs=${2:?--jobs needs a number}; shift ;;
    -*) usage >&2; exit 2 ;;
    *) targets+=("${1#fuzz_}") ;;
  esac
  shift
done
[[ $minutes =~ ^[1-9][0-9]*$ && $jobs =~ ^[1-9][0-9]*$ ]] || { usage >&2; exit 2; }

if ((${#targets[@]} == 0)); then
  for source in tests/fuzz/fuzz_*.cpp; do
    target=${source##*/fuzz_}
    [[ -e $source ]] && targets+=("${target%.cpp}")
  done
fi
((${#targets[@]} > 0)) || { echo "no fuzz targets" >&2; exit 2; }
for target in "${targets[@]}"; do
  [[ -e tests/fuzz/fuzz_$target.cpp ]] || { echo "no fuzz target '$target': see tests/fuzz/fuzz_*.cpp" >&2; exit 2; }
done
cmake --build --preset fuzz --parallel "${JOBS:-2}" --target "${targets[@]/#/fuzz_}"

run_one() {
  local target=$1 seconds=$2 folder=build/fuzz
  local log=$folder/$target.log code=0 executions
  mkdir -p "$folder/corpus/$target" "$folder/findings"
  cp -rn "tests/fuzz/corpus/$target/." "$folder/corpus/$target/" 2>/dev/null || true
  "$folder/bin/fuzz_$target" -max_total_time="$seconds" -max_len=65536 -timeout=10 -rss_limit_mb=2048 \
    -print_final_stats=1 -artifact_prefix="$folder/findings/$target-" "$folder/corpus/$target" >"$log" 2>&1 || code=$?
  executions=$(awk '/stat::number_of_executed_units/ { print $2 }' "$log")
  if ((code == 0)); then
    echo "$target: ${executions:-0} executions in $seconds s, no finding"
  else
    echo "$target: FINDING after ${executions:-?} executions (exit $code); the end of $log:"
    tail -n 40 "$log"
    return 1
  fi
}
export -f run_one
printf '%s\n' "${targets[@]}" | xargs -P "$jobs" -I{} bash -c 'run_one "$@"' run_one {} $((minutes * 60))
