# shellcheck shell=bash
# Starts and stops seekerd on a free port. Sourced by demo.sh, soak.sh and peers.sh. The programs are those of the release
# build, or of the folder SEEKER_BIN; SEEKERD names another seekerd.
#
# start_server LOG [OPTIONS...] sets server_pid and server_port; stop_server ends it and sets server_code, its exit code.
# Nothing is left running: the trap stops it however the script ends.

SEEKER_BIN=${SEEKER_BIN:-build/release/bin}
SEEKERD=${SEEKERD:-$SEEKER_BIN/seekerd}
server_pid=
server_port=
# shellcheck disable=SC2034  # read by the scripts that source this
server_code=0
server_folder=$(mktemp -d)

stop_server() {
  [[ -n $server_pid ]] || return 0
  local pid=$server_pid tries
  server_pid=
  kill -TERM "$pid" 2>/dev/null || true
  for ((tries = 0; tries < ${stop_tenths:-100}; ++tries)); do
    kill -0 "$pid" 2>/dev/null || break
    sleep 0.1
  done
  # Ten seconds are enough for an orderly end.
  kill -KILL "$pid" 2>/dev/null || true
  # shellcheck disable=SC2034
  server_code=0
  # shellcheck disable=SC2034  # read by the scripts that source this
  wait "$pid" 2>/dev/null || server_code=$?
}
trap 'stop_server; rm -rf "$server_folder"' EXIT
trap 'exit 130' INT
trap 'exit 143' TERM

start_server() {
  local log=$1 tries
  shift
  rm -f "$server_folder/port"
  $SEEKERD --port 0 --port-file "$server_folder/port" --state "$server_folder/state" "$@" >"$log" 2>&1 &
  server_pid=$!
  for ((tries = 0; tries < 300; ++tries)); do
    if [[ -s $server_folder/port ]]; then
      # shellcheck disable=SC2034  # read by the scripts that source this
      server_port=$(<"$server_folder/port")
      return 0
    fi
    kill -0 "$server_pid" 2>/dev/null || break
    sleep 0.1
  done
  echo "seekerd did not start; the end of $log:" >&2
  tail -n 20 "$log" >&2
  return 1
}

robot_file() {
  local file
  for file in config/robots/demo.yaml config/robots/sim.yaml; do
    [[ -e $file ]] && { echo "$file"; return; }
  done
  echo "no robot file in config/robots" >&2
  return 1
}
