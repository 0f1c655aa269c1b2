# Google Benchmark's JSON (one member a line) as a table: time, ratio to the first benchmark, the benchmark's own figures.
function value(line) { sub(/^[^:]*: */, "", line); sub(/,? *$/, "", line); gsub(/"/, "", line); return line }
function flush_row() {
  if (name == "") return
  ns = time * (unit == "s" ? 1e9 : unit == "ms" ? 1e6 : unit == "us" ? 1e3 : 1)
  if (first == 0) { first = ns; printf "  %-56s %12s %8s  %s\n", "benchmark", "time", "ratio", "figures" }
  if (error != "") printf "  %-56s %s\n", name, "ERROR: " error
  else printf "  %-56s %9.4g %-2s %8.3f  %s\n", name, time, unit, (first > 0 ? ns / first : 0), figures
  name = ""; figures = ""; error = ""
}
/"benchmarks": \[/ { inside = 1; next }
!inside { next }
/^ *}/ { flush_row(); next }
/"name":/ { name = value($0); next }
/"error_message":/ { error = value($0); next }
/"real_time":/ { time = value($0); next }
/"time_unit":/ { unit = value($0); next }
/"(family_index|per_family_instance_index|run_name|run_type|repetitions|repetition_index|threads|iterations|cpu_time|aggregate_name|aggregate_unit|error_occurred)":/ { next }
/"[^"]+": *-?[0-9]/ { key = $0; sub(/^ *"/, "", key); sub(/".*/, "", key); figures = figures sprintf("%s=%.4g ", key, value($0)) }
