#!/usr/bin/env bash
# The soak with a server that AddressSanitizer watches: a leak at its end, or any other finding, is a failure. Called by
# ./run soak asan MINUTES.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

minutes=${1:?minutes}
export SEEKERD=${SEEKERD:-build/asan/bin/seekerd}
export ASAN_OPTIONS=detect_leaks=1:halt_on_error=1:exitcode=99 UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1
# Freed memory is kept back to be watched, so that growth says little; looking for leaks takes its time at the end.
export stop_tenths=1200
hours=$(awk -v m="$minutes" 'BEGIN { print m / 60 }')
tests/soak/soak.sh --hours "$hours" --rounds 1 --limit-mb 4096
