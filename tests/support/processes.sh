# shellcheck shell=bash
# Programs that a script starts and stops, and the certificates that they show. Sourced by the scripts of tests/soak and
# tests/bench, in the top folder of the tree. The programs are those of the release build, or of the folder SEEKER_BIN;
# SEEKERD names another seekerd. Nothing is left running: a trap calls stop_all however the script ends.
#
# has_ended PID: whether the process is gone.
# stop_process PID [TENTHS]: asks it to end and waits for that; after TENTHS tenths of a second it is killed. Sets
#   stopped_code, its exit code. Harmless with an empty PID.
# wait_until TENTHS COMMAND...: calls COMMAND ten times a second until it succeeds; fails after TENTHS.
# wait_for_file TENTHS FILE PID: until the process has written the file; fails when it ends before, or after TENTHS.
# fail TEXT LOG: ends the script with TEXT and the end of LOG.
#
# start_server LOG [OPTIONS...]: seekerd on a free port, with its state below server_folder; sets server_pid and
#   server_port.
# stop_server: ends it and sets server_code, its exit code. stop_tenths says how long that may take.
# stop_all: stops all that the script has started; one that starts more than the server defines its own.
# robot_file: prints the simulated robot of the demo and the soak.
#
# make_site SITE HOST...: a CA, a robot sim-1 at these addresses and an operator anna, their bundles in SITE/bundles.
# tls_settings BUNDLE [KEY=VALUE...]: prints the options of seekerd with which it shows the bundle's certificate, a word a
#   line; with further ones of server.tls.

SEEKER_BIN=${SEEKER_BIN:-build/release/bin}
SEEKERD=${SEEKERD:-$SEEKER_BIN/seekerd}
server_pid=
server_port=
# shellcheck disable=SC2034  # read by the scripts that source this
server_code=0
stopped_code=0
server_folder=$(mktemp -d)

has_ended() { ! kill -0 "$1" 2>/dev/null; }

stop_process() {
  stopped_code=0
  [[ -n $1 ]] || return 0
  kill -TERM "$1" 2>/dev/null || true
  if (($# > 1)); then
    wait_until "$2" has_ended "$1" || kill -KILL "$1" 2>/dev/null || true
  fi
  wait "$1" 2>/dev/null || stopped_code=$?
}

wait_until() {
  local tries
  for ((tries = 0; tries < $1; ++tries)); do
    "${@:2}" && return 0
    sleep 0.1
  done
  return 1
}

wait_for_file() {
  local tries
  for ((tries = 0; tries < $1; ++tries)); do
    [[ ! -s $2 ]] || return 0
    ! has_ended "$3" || return 1
    sleep 0.1
  done
  return 1
}

fail() {
  echo "$(basename "$0" .sh): $1; the end of $2:" >&2
  tail -n 20 "$2" >&2
  exit 1
}

start_server() {
  local log=$1
  shift
  rm -f "$server_folder/port"
  $SEEKERD --port 0 --port-file "$server_folder/port" --state "$server_folder/state" "$@" >"$log" 2>&1 &
  server_pid=$!
  wait_for_file 300 "$server_folder/port" "$server_pid" || fail "seekerd did not start" "$log"
  # shellcheck disable=SC2034  # read by the scripts that source this
  server_port=$(<"$server_folder/port")
}

stop_server() {
  [[ -n $server_pid ]] || return 0
  local pid=$server_pid
  server_pid=
  # Ten seconds are enough for an orderly end.
  stop_process "$pid" "${stop_tenths:-100}"
  # shellcheck disable=SC2034  # read by the scripts that source this
  server_code=$stopped_code
}

stop_all() { stop_server; }
trap 'stop_all; rm -rf "$server_folder"' EXIT
trap 'exit 130' INT
trap 'exit 143' TERM

robot_file() {
  local file
  for file in config/robots/demo.yaml config/robots/sim.yaml; do
    [[ -e $file ]] && { echo "$file"; return; }
  done
  echo "no robot file in config/robots" >&2
  return 1
}

make_site() {
  local hosts=() host
  for host in "${@:2}"; do
    hosts+=(--host "$host")
  done
  local pki=("$SEEKER_BIN/seeker" --quiet pki)
  "${pki[@]}" init "$1" >/dev/null &&
    "${pki[@]}" issue sim-1 --role robot "${hosts[@]}" --site "$1" >/dev/null &&
    "${pki[@]}" issue anna --role operator --site "$1" >/dev/null
}

tls_settings() {
  printf -- '--set\nserver.tls.%s\n' "certificate=$1/cert.pem" "key=$1/key.pem" "ca=$1/ca.pem" "${@:2}"
}
