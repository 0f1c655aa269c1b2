#!/usr/bin/env bash
# Searches for hours and watches the server. Called by ./run soak.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

usage() {
  cat <<'TEXT'
./run soak [--hours N] [--rounds N] [--limit-mb N] [--first-seed N]: N hours (default 1, parts allowed) in rounds (default 4).
A round is one server with one seed that is asked for one search of the whole area after the other, and to come home after
each. Every search must end with exit code 0 (found) or 6 (not found), every way home with 0, and the server's memory may grow
by the limit (default 64 MB) at most after the second search of its round. Samples: build/soak/memory.csv.
./run soak cuts [N]: a simulated robot is driven by hand over a link that is cut N times (default 1000); it must stand each time.
./run soak kills [N]: the server of a busy robot is killed N times (default 500); all that it has acknowledged must be there.
TEXT
}

hours=1
rounds=4
limit_mb=64
seed=1
while (($# > 0)); do
  case $1 in
    --help) usage; exit 0 ;;
    --hours) hours=${2:?}; shift ;;
    --rounds) rounds=${2:?}; shift ;;
    --limit-mb) limit_mb=${2:?}; shift ;;
    --first-seed) seed=${2:?}; shift ;;
    *) usage >&2; exit 2 ;;
  esac
  shift
done
source tests/soak/server.sh

resident_kb() { awk '/^VmRSS:/ { print $2 }' "/proc/$server_pid/status"; }
seconds_per_round=$(awk -v h="$hours" -v r="$rounds" 'BEGIN { print int(h * 3600 / r) }')
mkdir -p build/soak
samples=build/soak/memory.csv
echo "round,seed,search,exit_code,seconds,resident_kb" >"$samples"
robot=$(robot_file)
searches=0

# One search, its exit code checked, its memory noted.
search_once() {
  local round=$1 number=$2 code=0 home=0 begin=$SECONDS log=build/soak/client-$1.log
  local client=(build/release/bin/seeker --robot "127.0.0.1:$server_port")
  "${client[@]}" search --target cross --on-found continue >"$log" 2>&1 || code=$?
  "${client[@]}" goto --home >>"$log" 2>&1 || home=$?
  kill -0 "$server_pid" 2>/dev/null || { echo "round $round: the server died; see build/soak/server-$round.log"; return 1; }
  echo "$round,$seed,$number,$code,$((SECONDS - begin)),$(resident_kb)" >>"$samples"
  if ((code != 0 && code != 6 || home != 0)); then
    echo "round $round, seed $seed, search $number: the client ended with $code, on the way home with $home:"
    tail -n 20 "$log"
    return 1
  fi
}

for ((round = 1; round <= rounds; ++round, ++seed)); do
  rm -rf "$server_folder/state"
  start_server "build/soak/server-$round.log" --config "$robot" --set "sim.seed=$seed"
  end=$((SECONDS + seconds_per_round))
  first_kb=0
  number=0
  # At least three searches: the first two fill caches and buffers.
  while ((SECONDS < end || number < 3)); do
    number=$((number + 1))
    search_once "$round" "$number"
    ((number == 2)) && first_kb=$(resident_kb)
  done
  growth_kb=$(($(resident_kb) - first_kb))
  echo "round $round, seed $seed: $number searches, memory $first_kb kB after the second, $growth_kb kB more at the end"
  searches=$((searches + number))
  ((growth_kb <= limit_mb * 1024)) || { echo "the server's memory grew by more than $limit_mb MB"; exit 1; }
  stop_server
done
echo "$searches searches in $rounds rounds, no failure"
