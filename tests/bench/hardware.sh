#!/usr/bin/env bash
# What seekerd costs on a robot with real devices, which seeker-emulator plays. Called by ./run bench hardware.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

usage() {
  cat <<'TEXT'
./run bench hardware [--seconds N] [--baud RATE]...: starts seekerd with config/robots/pioneer3dx_lms200.yaml, its base
and laser scanner on pseudo-terminals that seeker-emulator plays in real time, and prints the processor time of seekerd
(/proc/PID/stat) in per cent of one core over N seconds (default 60): at rest, and on a `seeker explore` mission. RATE is
that of the scanner's line; by default 38400, and 500000, at which all scans fit on it. Goal: 10 % at most, without vision.
Leaves the logs in build/bench/hardware.
TEXT
}

seconds=60
bauds=()
while (($# > 0)); do
  case $1 in
    --help) usage; exit 0 ;;
    --seconds) seconds=${2:?--seconds needs a number}; shift ;;
    --baud) bauds+=("${2:?--baud needs a rate}"); shift ;;
    *) usage >&2; exit 2 ;;
  esac
  shift
done
((${#bauds[@]} > 0)) || bauds=(38400 500000)

source tests/support/processes.sh
readonly goal_percent=10
readonly world=config/worlds/office.yaml
readonly robot=config/robots/pioneer3dx_lms200.yaml
readonly start_tenths=600
readonly settle_s=5
out=build/bench/hardware
mkdir -p "$out"
emulator_pid=
client_pid=

stop_all() {
  stop_process "$client_pid"
  client_pid=
  stop_server
  stop_process "$emulator_pid"
  emulator_pid=
}

start_emulator() {
  rm -f "$server_folder/devices"
  build/release/bin/seeker-emulator --world "$world" --config config/robots/live.yaml --robots 1 \
    --set sim.people=false --port 0 --devices-file "$server_folder/devices" --device "p2os@$server_folder/base" \
    --device "lms200@$server_folder/lidar" >"$out/emulator.log" 2>&1 &
  emulator_pid=$!
  wait_for_file "$start_tenths" "$server_folder/devices" "$emulator_pid" ||
    fail "seeker-emulator did not start" "$out/emulator.log"
}

seeker() {
  build/release/bin/seeker --robot "127.0.0.1:$server_port" "$@"
}

# packets COMPONENT: whole packets that have come over its line.
packets() {
  seeker components | awk -v name="$1" '/^[a-z]/ { component = $1 } component == name && $1 == "line" { print $2 }'
}

scanner_delivers() {
  local lidar
  lidar=$(packets lidar)
  ((${lidar:-0} > 50))
}

# Processor time of seekerd in ticks of the kernel: fields 14 and 15, counted behind the program's name.
processor_ticks() {
  sed 's/.*) //' "/proc/$server_pid/stat" | awk '{ print $12 + $13 }'
}

# measure BAUD LOAD: a row of the table.
measure() {
  local ticks_before ns_before scans_before sips_before
  ticks_before=$(processor_ticks) ns_before=$(date +%s%N) scans_before=$(packets lidar) sips_before=$(packets base)
  sleep "$seconds"
  ! has_ended "$emulator_pid" || fail "seeker-emulator has ended" "$out/emulator.log"
  [[ -z $client_pid ]] || ! has_ended "$client_pid" || fail "the mission ended too early" "$out/explore.log"
  awk -v baud="$1" -v load="$2" -v ticks=$(($(processor_ticks) - ticks_before)) -v hz="$(getconf CLK_TCK)" \
    -v ns=$(($(date +%s%N) - ns_before)) -v scans=$(($(packets lidar) - scans_before)) \
    -v sips=$(($(packets base) - sips_before)) -v goal="$goal_percent" 'BEGIN {
      s = ns / 1e9; percent = 100 * ticks / hz / s
      printf "  %8d %-9s %9.1f %9.1f %9.1f %8.0f %s\n", baud, load, scans / s, sips / s, percent, goal,
        percent <= goal ? "" : "MISSED"
      exit percent > goal
    }'
}

code=0
printf '  %8s %-9s %9s %9s %9s %8s\n' baud load 'scans/s' 'base/s' 'core %' 'goal %'
for baud in "${bauds[@]}"; do
  start_emulator
  start_server "$out/seekerd.log" --config "$robot" --set "hardware.base.port=$server_folder/base" \
    --set "hardware.lidar.port=$server_folder/lidar" --set "hardware.lidar.lms200.baud=$baud"
  wait_until "$start_tenths" scanner_delivers || fail "the devices do not deliver" "$out/seekerd.log"
  sleep "$settle_s"
  measure "$baud" idle || code=1
  seeker explore >"$out/explore.log" 2>&1 &
  client_pid=$!
  sleep "$settle_s"
  measure "$baud" explore || code=1
  stop_all
done
exit "$code"
