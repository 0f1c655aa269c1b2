#!/usr/bin/env bash
# Runs the benchmarks and prints a table. Called by ./run bench.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

if [[ ${1-} == --help ]]; then
  cat <<'TEXT'
./run bench [NAME...]: runs bench_NAME (default: all) one after the other and leaves build/bench/results/NAME.json.
The table gives the time of each benchmark, its ratio to the first one of its program (below 1: faster), and the figures
that it reports itself.
./run bench peers compares with other programs instead, ./run bench hardware measures a robot with emulated devices,
./run bench link the operator's link beside gRPC; see their --help.
TEXT
  exit 0
fi

results=build/bench/results
mkdir -p "$results"
programs=("${@/#/build/bench/bin/bench_}")
(($# > 0)) || programs=(build/bench/bin/bench_*)
code=0
for program in "${programs[@]}"; do
  [[ -x $program ]] || { echo "no benchmark $program" >&2; exit 2; }
  name=${program##*/bench_}
  echo "== $name"
  "$program" --benchmark_out="$results/$name.json" --benchmark_out_format=json --benchmark_format=console \
    >"$results/$name.txt" 2>&1 || { code=1; echo "FAILED, the end of $results/$name.txt:"; tail -n 20 "$results/$name.txt"; continue; }
  awk -f tests/bench/table.awk "$results/$name.json"
done
exit "$code"
