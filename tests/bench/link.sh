#!/usr/bin/env bash
# What the operator's link takes and costs, beside gRPC. Called by ./run bench link.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

usage() {
  cat <<'TEXT'
./run bench link [--seconds N] [--clients N] [--pairs N] [--cuts N]: a robot that publishes its status at 20 Hz and
images of 60 kB at 10 Hz over mutual TLS, once by Seeker's link and once by gRPC (Debian's, callback interface, each
update encoded once, the same messages and certificates), in turn, --pairs times (default 5). Printed are
  state     from the stamp of a status to a client that has read it, in a process of its own
  act       from a command to where the robot obeys it; drive: to its answer
  beside    with N clients in another process (--clients, default 50) that receive status and images; alone: without
  fresh     from the cut of a connection to the first status of after the cut (--cuts, default 50 a run)
  each      what each client with images costs the robot's process; 200 of them in its memory
  map       bytes a minute of robot time of a seekerd that stands and that explores, against sending the whole map at
            each change: as one grid of a byte a cell, and as all compressed tiles
Robot and measuring client run before other programs (chrt --rr 1), where that is allowed. Figures are of all runs
together, ratios the median of the pairs' ratios: other programs disturb both stacks alike. `waited`: how long the
robot's threads were ready but had no processor. A latency run lasts --seconds (default 20). Where gRPC is not installed
Seeker is measured alone. Goals: state p99 beside others at most 5 ms; no latency above gRPC's; 200 clients in 256 MiB;
1/20 of the bytes of whole maps as grids. Leaves build/bench/results/link.json and the samples in build/bench/link.
TEXT
}

seconds=20
clients=50
pairs=5
cuts=50
while (($# > 0)); do
  case $1 in
    --help) usage; exit 0 ;;
    --seconds) seconds=${2:?--seconds needs a number}; shift ;;
    --clients) clients=${2:?--clients needs a number}; shift ;;
    --pairs) pairs=${2:?--pairs needs a number}; shift ;;
    --cuts) cuts=${2:?--cuts needs a number}; shift ;;
    *) usage >&2; exit 2 ;;
  esac
  shift
done

source tests/support/processes.sh
readonly few_clients=10
readonly crowd=200
readonly crowd_s=5
readonly start_tenths=1200
readonly idle_s=60
readonly explore_s=300 # robot time
readonly explore_speed=4
bin=build/bench/bin
out=build/bench/link
figures=$out/figures
site=$server_folder/site
robot=$site/bundles/sim-1
operator=$site/bundles/anna
host_pid=
host_port=
load_pid=

stop_all() {
  stop_process "$load_pid"
  load_pid=
  stop_process "$host_pid"
  host_pid=
  stop_server
}

# wait_for FILE PID LOG: until a program that was started has written the file.
wait_for() {
  wait_for_file "$start_tenths" "$1" "$2" || fail "a program did not start" "$3"
}

# start_host STACK NAME
start_host() {
  rm -f "$server_folder/host-port"
  "${first[@]}" "$bin/link_host_$1" --bundle "$robot" --port-file "$server_folder/host-port" --acts "$out/$2.acts" \
    >"$out/$2.host.log" 2>&1 &
  host_pid=$!
  wait_for "$server_folder/host-port" "$host_pid" "$out/$2.host.log"
  host_port=$(<"$server_folder/host-port")
}

# start_crowd STACK NAME CLIENTS. With less priority: on other computers they would take no processor time of the robot.
start_crowd() {
  (($3 > 0)) || return 0
  rm -f "$server_folder/ready"
  nice -n 10 "$bin/link_load_$1" --bundle "$operator" --port "$host_port" --clients "$3" \
    --ready-file "$server_folder/ready" >"$out/$2.crowd.log" 2>&1 &
  load_pid=$!
  wait_for "$server_folder/ready" "$load_pid" "$out/$2.crowd.log"
}

# keep PAIR STACK SCENARIO < lines "name value"
keep() {
  sed "s/^/$1 $2 $3 /" >>"$figures"
}

# quantiles NAME < samples: lines "NAME_p50 value" ...
quantiles() {
  sort -g | awk -v name="$1" '
    { value[NR] = $1 }
    function at(q,   k) { k = int(q * NR); if (k < q * NR) ++k; return value[k < 1 ? 1 : k] }
    END { if (NR > 0) printf "%s_p50 %s\n%s_p99 %s\n%s_p99.9 %s\n", name, at(0.5), name, at(0.99), name, at(0.999) }'
}

# latencies PAIR STACK SCENARIO CLIENTS SECONDS
latencies() {
  local name=$1.$2.$3
  start_host "$2" "$name"
  start_crowd "$2" "$name" "$4"
  "${first[@]}" "$bin/link_load_$2" --bundle "$operator" --port "$host_port" --seconds "$5" --host-pid "$host_pid" \
    --states "$out/$name.states" --drives "$out/$name.drives" >"$out/$name.load.log" 2>&1 ||
    fail "the measuring client failed" "$out/$name.load.log"
  stop_all
  keep "$1" "$2" "$3" <"$out/$name.load.log"
  [[ ! -e $out/$name.crowd.log ]] || keep "$1" "$2" "$3" <"$out/$name.crowd.log"
  local kind
  for kind in state act drive; do
    quantiles "$kind" <"$out/$name.${kind}s" | keep "$1" "$2" "$3"
  done
}

# reconnects PAIR STACK
reconnects() {
  local name=$1.$2.cut
  start_host "$2" "$name"
  "${first[@]}" "$bin/link_load_$2" --bundle "$operator" --port "$host_port" --cuts "$cuts" \
    --states "$out/$name.states" >"$out/$name.load.log" 2>&1 || fail "the cut client failed" "$out/$name.load.log"
  stop_all
  quantiles fresh <"$out/$name.states" | keep "$1" "$2" cut
}

# pooled STACK SCENARIO KIND: of all runs.
pooled() {
  local suffix=$3s
  [[ $3 == fresh ]] && suffix=states
  cat "$out"/[0-9]*."$1.$2.$suffix" | quantiles "$3" | keep all "$1" "$2"
}

# map_bytes SCENARIO SPEED SECONDS [OPTIONS]
map_bytes() {
  local scenario=$1 speed=$2 counted_s=$3
  shift 3
  local settings
  mapfile -t settings < <(tls_settings "$robot")
  start_server "$out/$scenario.seekerd.log" --config config/robots/sim.yaml --set sim.world=config/worlds/office.yaml \
    --set "sim.speed=$speed" "${settings[@]}"
  "$bin/link_map_bytes" --bundle "$operator" --port "$server_port" --seconds "$counted_s" "$@" \
    >"$out/$scenario.log" 2>&1 || fail "the map was not counted" "$out/$scenario.log"
  stop_server
  keep all seeker "$scenario" <"$out/$scenario.log"
}

rm -rf "$out"
mkdir -p "$out" build/bench/results
make_site "$site" 127.0.0.1 >"$out/pki.log" 2>&1 || fail "no certificates could be made" "$out/pki.log"
# The clients with images stand for other computers: they must not take the processor from the robot when they wake.
first=()
if chrt --rr 1 true 2>/dev/null; then
  first=(chrt --rr 1)
else
  echo "link: real-time priority is not allowed here: latencies are those of the scheduler, too" >&2
fi
stacks=(seeker grpc)
[[ -x $bin/link_host_grpc ]] || stacks=(seeker)
for ((pair = 1; pair <= pairs; ++pair)); do
  # Which of both comes first changes with the pair.
  ordered=("${stacks[@]}")
  ((pair % 2 == 1 || ${#stacks[@]} == 1)) || ordered=(grpc seeker)
  for scenario in alone few beside cut; do
    for stack in "${ordered[@]}"; do
      case $scenario in
        alone) latencies "$pair" "$stack" alone 0 "$seconds" ;;
        few) latencies "$pair" "$stack" few "$few_clients" "$seconds" ;;
        beside) latencies "$pair" "$stack" beside "$clients" "$seconds" ;;
        cut) reconnects "$pair" "$stack" ;;
      esac
    done
  done
done
# Memory alone is of interest here; robots that go before so many clients would leave them no processor.
first=()
for stack in "${stacks[@]}"; do
  latencies 0 "$stack" crowd "$crowd" "$crowd_s"
  for scenario in alone beside; do
    for kind in state act drive; do
      pooled "$stack" "$scenario" "$kind"
    done
  done
  pooled "$stack" cut fresh
done
map_bytes idle 1 "$idle_s"
map_bytes mapping "$explore_speed" "$explore_s" --explore
awk -v pairs="$pairs" -v clients="$clients" -v few="$few_clients" -v crowd="$crowd" \
  -v json=build/bench/results/link.json -f tests/bench/link/table.awk "$figures"
