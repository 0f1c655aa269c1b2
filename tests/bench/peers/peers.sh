#!/usr/bin/env bash
# Seeker and MRPT's icp-slam over the same recorded logs, one after the other. Called by ./run bench peers.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../../.."

usage() {
  cat <<'TEXT'
./run bench peers [--estimator NAME]... [--log fr079|intel]...: runs seeker-lab slam and Debian's icp-slam (mrpt-apps) over
the recorded logs, scores all of them with seeker-lab score, and prints one table with the ratios Seeker / peer (below 1:
Seeker is better). Leaves everything in build/bench/peers. SEEKER_DATA names the folder of the recordings.
icp-slam runs twice: with the values of its own classic example, and with every point matched every 0.1 m ("dense").
Wall time includes reading the log. "processor s" is not lengthened by other work on the machine; ms per scan is.
TEXT
}

estimators=()
logs=()
while (($# > 0)); do
  case $1 in
    --help) usage; exit 0 ;;
    --estimator) estimators+=("${2:?--estimator needs a name}"); shift ;;
    --log) logs+=("${2:?--log needs a name}"); shift ;;
    *) usage >&2; exit 2 ;;
  esac
  shift
done
((${#estimators[@]} > 0)) || estimators=("")
((${#logs[@]} > 0)) || logs=(fr079 intel)

readonly data=${SEEKER_DATA:-../shared/data}/lidar
readonly lab=build/release/bin/seeker-lab
readonly out=build/bench/peers
readonly here=tests/bench/peers
# Clock of the relations minus clock of the log, s.
declare -A offset=([fr079]=1211.40 [intel]=0)

for program in carmen2rawlog icp-slam /usr/bin/time perl; do
  command -v "$program" >/dev/null || { echo "peers: $program is missing (packages mrpt-apps, time, perl)" >&2; exit 1; }
done
for log in "${logs[@]}"; do
  [[ -n ${offset[$log]-} ]] || { usage >&2; exit 2; }
  [[ -e $data/$log.clf.gz ]] || { echo "peers: skipped, no recorded data $data/$log.clf.gz (set SEEKER_DATA)" >&2; exit 0; }
done
mkdir -p "$out"

# number FILE OBJECT... KEY: a number of a report, which has one outermost member a line.
number() {
  local file=$1 pattern='' part between='.*'
  shift
  (($# > 2)) && between='[^}]*'
  for part in "${@:1:$#-1}"; do
    pattern+="\"$part\": *{.*"
  done
  sed -n "s/.*${pattern%.\*}$between\"${!#}\": *\([-+0-9.e]*\).*/\1/p" "$file" | head -n 1
}

# rate LOG TRAJECTORY SCORE
rate() {
  "$lab" score "$2" --relations "$data/$1.relations.gz" --time-offset "${offset[$1]}" --json >"$3"
}

# row LOG NAME WALL PROCESSOR MEAN P99 MEMORY SCORE
row() {
  printf '%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\t%s\n' "${@:1:7}" \
    "$(number "$8" all translation_m mean)" "$(number "$8" all translation_m std)" \
    "$(number "$8" all translation_m median)" "$(number "$8" all rotation_deg mean)"
}

# run_seeker LOG ESTIMATOR
run_seeker() {
  local folder=$out/$1-seeker${2:+-$2}
  "$lab" slam "$data/$1.clf.gz" --out "$folder" ${2:+--estimator "$2"} >"$folder.txt" 2>&1 || { cat "$folder.txt" >&2; return 1; }
  rate "$1" "$folder/trajectory.tum" "$folder/score.json"
  row "$1" "seeker${2:+ $2}" "$(number "$folder/report.json" cost wall_s)" \
    "$(number "$folder/report.json" cost processor_s)" "$(number "$folder/report.json" cost scan mean_ms)" "$(number "$folder/report.json" cost scan p99_ms)" \
    "$(number "$folder/report.json" cost memory_peak_mb)" "$folder/score.json"
}

# The log with odometry as its only poses: carmen2rawlog takes the difference of both triplets for the laser's mount.
convert() {
  [[ -e $out/$1.rawlog ]] && return 0
  zcat "$data/$1.clf.gz" |
    awk '/^FLASER/ { b = $2 + 3; for (k = 0; k < 3; ++k) $(b + k) = $(b + 3 + k); print }' >"$out/$1.clf"
  rm -f "$out/$1.plain.rawlog"
  carmen2rawlog -q -w -i "$out/$1.clf" -o "$out/$1.plain.rawlog" >/dev/null
  zcat -f "$out/$1.plain.rawlog" | perl "$here/stamp_rawlog.pl" "$out/$1.clf" >"$out/$1.rawlog.new"
  mv "$out/$1.rawlog.new" "$out/$1.rawlog"
}

# run_mrpt LOG NAME [KEY=VALUE...]
run_mrpt() {
  local log=$1 name=$2 folder=$PWD/$out/$1-mrpt-$2 setting
  shift 2
  convert "$log"
  rm -rf "$folder"
  sed "s|@RAWLOG@|$PWD/$out/$log.rawlog|; s|@OUT@|$folder|" "$here/icp-slam.ini" >"$folder.ini"
  for setting in "$@"; do
    sed -i -E "s|^(${setting%%=*}) *=.*|\1 = ${setting#*=}|" "$folder.ini"
  done
  /usr/bin/time -f '%e %U %S %M' -o "$folder.cost" icp-slam "$folder.ini" >"$folder.txt" 2>&1 ||
    { tail -n 5 "$folder.txt" >&2; return 1; }
  # Records are numbered from 0, odometry and scan in turn.
  awk 'NR == FNR { t[n++] = $(NF - 2); next }
       $1 % 2 == 1 { printf "%s %s %s 0 0 0 %.12f %.12f\n", t[($1 - 1) / 2], $2, $3, sin($4 / 2), cos($4 / 2) }' \
    "$out/$log.clf" "$folder/log_estimated_path.txt" >"$folder.tum"
  rate "$log" "$folder.tum" "$folder.json"
  # Milliseconds a record.
  awk 'NR % 2 == 1 { odometry = $1 } NR % 2 == 0 { print odometry + $1 }' "$folder/log_times.txt" | sort -g >"$folder.ms"
  row "$log" "icp-slam $name" "$(awk '{ print $1 }' "$folder.cost")" "$(awk '{ print $2 + $3 }' "$folder.cost")" \
    "$(awk '{ s += $1 } END { print s / NR }' "$folder.ms")" \
    "$(awk '{ a[NR] = $1 } END { k = int(0.99 * NR); print a[k < 0.99 * NR ? k + 1 : k] }' "$folder.ms")" \
    "$(awk '{ print $4 / 1024 }' "$folder.cost")" "$folder.json"
}

: >"$out/rows.tsv"
for log in "${logs[@]}"; do
  for estimator in "${estimators[@]}"; do
    run_seeker "$log" "$estimator" >>"$out/rows.tsv"
  done
  run_mrpt "$log" classic >>"$out/rows.tsv"
  run_mrpt "$log" dense corresponding_points_decimation=1 localizationLinDistance=0.1 localizationAngDistance=2 >>"$out/rows.tsv"
done
awk -f "$here/table.awk" "$out/rows.tsv" | tee "$out/table.txt"
