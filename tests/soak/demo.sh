#!/usr/bin/env bash
# Called by ./run demo once the programs are built.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/support/processes.sh

mkdir -p out
rm -f out/demo.*
robot=$(robot_file)
start_server out/demo-server.log --config "$robot"
echo "seekerd runs $robot on port $server_port (log: out/demo-server.log)"

code=0
"$SEEKER_BIN/seeker" --robot "127.0.0.1:$server_port" search --target cross --save out/demo || code=$?
stop_server

echo
for file in out/demo.*; do
  [[ -e $file ]] && echo "left $file"
done
exit "$code"
