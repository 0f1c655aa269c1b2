#!/usr/bin/env bash
# Searches for hours while clients come and go, and watches the server. Called by ./run soak.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

usage() {
  cat <<'TEXT'
./run soak [--hours N] [--rounds N] [--limit-mb N] [--first-seed N]: N hours (default 1, parts allowed) in rounds (default 4).
A round is one server with one seed that is asked for one search of the whole area after the other, and to come home after
each, while other clients come, follow, are killed in the middle, and leave. Every search must end with exit code 0 (found) or
6 (not found), every way home with 0, no client may see a fault, and the server's memory may grow by the limit (default 64 MB)
at most after the second search of its round. The slope of the memory is a least-squares line over the second half of the
round: the streams' backlogs fill meanwhile. Samples: build/soak/memory.csv, build/soak/visits.csv.
./run soak asan [MINUTES]: the same for so many minutes (default 10), the server built with AddressSanitizer; a leak is a failure.
./run soak cuts [N]: a simulated robot is driven by hand over a link that is cut N times (default 1000); it must stand each time.
./run soak faults [N]: missions over a link that breaks N times (default 1000) in every way; no item, upload or mission is lost.
./run soak sweep: what an operator reaches over links of each kind and level, into build/soak/impairments.csv.
./run soak abuse [N]: N connections (default 10000) torment a port, with TLS and without; the control loop must not notice.
./run soak peers: openssl and testssl.sh judge the TLS side; tc netem delays, loses and throttles between two namespaces.
./run soak calibration [N]: wheels and mounts that are wrong are found on seeds 1 to N (default 3).
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
source tests/support/processes.sh

resident_kb() { awk '/^VmRSS:/ { print $2 }' "/proc/$server_pid/status"; }
seconds_per_round=$(awk -v h="$hours" -v r="$rounds" 'BEGIN { print int(h * 3600 / r) }')
mkdir -p build/soak
samples=build/soak/memory.csv
visits=build/soak/visits.csv
echo "round,seed,search,exit_code,seconds,resident_kb" >"$samples"
echo "round,seconds,visitor,resident_kb,faults" >"$visits"
robot=$(robot_file)
searches=0
visitor_pid=

# The faults that a client sees, as JSON; "?" where it has no answer.
faults_seen() {
  local status
  status=$("$SEEKER_BIN/seeker" --robot "127.0.0.1:$server_port" --timeout 20 status --json 2>/dev/null) || { echo '?'; return; }
  grep -o '"faults":\[.*\]' <<<"$status" | cut -c10- || echo '?'
}

# One that follows and says goodbye, one that is killed in the middle, one that takes a picture, one that only asks.
visit() {
  local client=("$SEEKER_BIN/seeker" --robot "127.0.0.1:$server_port" --as "visitor-$1")
  local topics=status,scan,tiles,grid,mission,event,segments
  local follow=(watch --json --topics "$topics" --rate 20)
  case $1 in
    leaves) timeout -s INT 2 "${client[@]}" "${follow[@]}" || true ;;
    killed) timeout -s KILL 1 "${client[@]}" "${follow[@]}" || true ;;
    picture) "${client[@]}" camera grab --out "$server_folder/view.png" || true ;;
    asks) "${client[@]}" grid || true ;;
  esac >/dev/null 2>&1
}

# Runs beside the searches until it is ended.
visitors() {
  local round=$1 begin=$SECONDS who
  while :; do
    for who in leaves killed picture asks; do
      visit "$who"
      echo "$round,$((SECONDS - begin)),$who,$(resident_kb),$(faults_seen)" >>"$visits"
    done
  done
}

stop_visitors() {
  stop_process "$visitor_pid"
  visitor_pid=
}
stop_all() {
  stop_visitors
  stop_server
}

# One search, its exit code checked, its memory noted.
search_once() {
  local round=$1 number=$2 code=0 home=0 begin=$SECONDS log=build/soak/client-$1.log
  local client=("$SEEKER_BIN/seeker" --robot "127.0.0.1:$server_port")
  "${client[@]}" search --target cross --on-found continue >"$log" 2>&1 || code=$?
  "${client[@]}" goto --home >>"$log" 2>&1 || home=$?
  ! has_ended "$server_pid" || { echo "round $round: the server died; see build/soak/server-$round.log"; return 1; }
  echo "$round,$seed,$number,$code,$((SECONDS - begin)),$(resident_kb)" >>"$samples"
  if ((code != 0 && code != 6 || home != 0)); then
    echo "round $round, seed $seed, search $number: the client ended with $code, on the way home with $home:"
    tail -n 20 "$log"
    return 1
  fi
}

# slope ROUND FROM_S: kB per hour of the memory that visitors have seen since then.
slope() {
  awk -F, -v round="$1" -v from="$2" '
    $1 == round && $2 >= from { n++; x = $2 / 3600; sx += x; sy += $4; sxx += x * x; sxy += x * $4 }
    END {
      d = n * sxx - sx * sx
      if (n < 3 || d <= 0) { print "unknown (too few samples)"; exit }
      printf "%+.0f kB/hour over %d samples\n", (n * sxy - sx * sy) / d, n
    }' "$visits"
}

no_fault_seen() {
  local seen
  seen=$(awk -F, -v round="$1" 'NR > 1 && $1 == round && $5 != "[]"' "$visits")
  [[ -z $seen ]] || { echo "round $1: visitors have seen faults, or had no answer:"; echo "$seen" | head -n 5; return 1; }
}

for ((round = 1; round <= rounds; ++round, ++seed)); do
  rm -rf "$server_folder/state"
  start_server "build/soak/server-$round.log" --config "$robot" --set "sim.seed=$seed"
  begin=$SECONDS
  end=$((SECONDS + seconds_per_round))
  first_kb=0
  number=0
  visitors "$round" &
  visitor_pid=$!
  # At least three searches: the first two fill caches and buffers.
  while ((SECONDS < end || number < 3)); do
    number=$((number + 1))
    search_once "$round" "$number"
    ((number == 2)) && first_kb=$(resident_kb)
  done
  growth_kb=$(($(resident_kb) - first_kb))
  stop_visitors
  echo "round $round, seed $seed: $number searches, $(grep -c "^$round," "$visits") visits, memory $first_kb kB after the" \
    "second search, $growth_kb kB more at the end; slope $(slope "$round" $(((SECONDS - begin) / 2)))"
  searches=$((searches + number))
  no_fault_seen "$round"
  ((growth_kb <= limit_mb * 1024)) || { echo "the server's memory grew by more than $limit_mb MB"; exit 1; }
  stop_server
  ((server_code == 0)) || { echo "the server ended with $server_code:"; tail -n 40 "build/soak/server-$round.log"; exit 1; }
done
echo "$searches searches in $rounds rounds, no failure"
