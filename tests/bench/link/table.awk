# Lines "PAIR STACK SCENARIO NAME VALUE" of tests/bench/link.sh as a table, and as JSON in the file `json`. Figures of PAIR
# "all" are of all runs together; ratios are the median of the pairs'. Exit code 1: a goal was missed.
function median(list, n,   i, j, t) {
  for (i = 2; i <= n; ++i) for (j = i; j > 1 && list[j] < list[j - 1]; --j) { t = list[j]; list[j] = list[j - 1]; list[j - 1] = t }
  return n == 0 ? "" : n % 2 ? list[(n + 1) / 2] : (list[n / 2] + list[n / 2 + 1]) / 2
}
# Of one stack in one pair: a figure, or what each of the `n` clients with images of a scenario adds to it.
function one(pair, stack, scenario, name) { return value[pair, stack, scenario, name] }
function added(pair, stack, scenario, n, name) { return (one(pair, stack, scenario, name) - one(pair, stack, "alone", name)) / n }
function number(x) { return x == "" ? "-" : sprintf(x >= 1000 || x == int(x) ? "%.0f" : x >= 10 ? "%.1f" : "%.3f", x) }
function quoted(x) { return x == "" ? "null" : x }
function row(text, unit, seeker, grpc, ratio, goal, is_missed) {
  printf "  %-38s %-7s %11s %11s %8s  %-20s%s\n", text, unit, number(seeker), number(grpc), ratio == "" ? "-" : sprintf("%.3f", ratio), goal, is_missed ? "MISSED" : ""
  rows = rows (rows == "" ? "" : ",\n") sprintf("    {\"figure\": \"%s\", \"unit\": \"%s\", \"seeker\": %s, \"grpc\": %s, \"ratio\": %s, \"goal\": \"%s\", \"missed\": %s}", text, unit, quoted(seeker), quoted(grpc), quoted(ratio), goal, is_missed ? "true" : "false")
  missed += is_missed
}
function ratio_of(scenario, name,   p, n, list) {
  for (p = 1; p <= pairs; ++p) if (one(p, "grpc", scenario, name) > 0) list[++n] = one(p, "seeker", scenario, name) / one(p, "grpc", scenario, name)
  return median(list, n + 0)
}
function latency(text, scenario, name, most_us,   ratio, seeker, goal, bad) {
  seeker = one("all", "seeker", scenario, name)
  ratio = name ~ /p99\.9/ ? "" : ratio_of(scenario, name)
  goal = ratio == "" ? "" : "ratio <= 1"
  bad = ratio != "" && ratio > 1
  if (most_us) { goal = goal (goal == "" ? "" : ", ") "<= " most_us; bad = bad || seeker > most_us }
  row(text, "us", seeker, one("all", "grpc", scenario, name), ratio, goal, bad)
}
function cost(text, unit, scenario, each, name, factor,   p, n, s, g, r) {
  for (p = 1; p <= pairs; ++p) {
    s[p] = factor * added(p, "seeker", scenario, each, name)
    if ((p, "grpc", scenario, name) in value) { g[++n] = factor * added(p, "grpc", scenario, each, name); if (g[n] > 0) r[n] = s[p] / g[n] }
  }
  row(text, unit, median(s, pairs), median(g, n + 0), median(r, n + 0), "", 0)
}
function of_pairs(stack, scenario, name, factor,   p, n, list) {
  for (p = 1; p <= pairs; ++p) if ((p, stack, scenario, name) in value) list[++n] = factor * one(p, stack, scenario, name)
  return median(list, n + 0)
}
function delivered(text, unit, name, factor) {
  row(text, unit, of_pairs("seeker", "beside", name, factor), of_pairs("grpc", "beside", name, factor), ratio_of("beside", name), "", 0)
}
function map_rows(scenario,   ours, packed, grids) {
  ours = one("all", "seeker", scenario, "tiles") + one("all", "seeker", scenario, "segments")
  packed = one("all", "seeker", scenario, "whole_tiles") + one("all", "seeker", scenario, "whole_segments")
  grids = one("all", "seeker", scenario, "whole_grids") + one("all", "seeker", scenario, "whole_segments")
  row(scenario ": received, with TLS", "kB/min", one("all", "seeker", scenario, "received") / 1000, "", "", "", 0)
  row(scenario ": status", "kB/min", one("all", "seeker", scenario, "states") / 1000, "", "", "", 0)
  row(scenario ": map (tiles, segments)", "kB/min", ours / 1000, "", "", "", 0)
  row(scenario ": whole maps as grids", "kB/min", grids / 1000, "", "", "", 0)
  row(scenario ": whole maps as packed tiles", "kB/min", packed / 1000, "", "", "", 0)
  if (scenario == "mapping" && ours > 0) {
    row("map bytes, whole grids over ours", "times", grids / ours, "", "", ">= 20", grids / ours < 20)
    row("map bytes, whole packed tiles over ours", "times", packed / ours, "", "", "", 0)
  }
}
{ value[$1, $2, $3, $4] = $5 }
END {
  printf "  %-38s %-7s %11s %11s %8s  %s\n", "figure", "unit", "seeker", "grpc", "ratio", "goal"
  split("alone beside", scenarios, " ")
  split("state act drive", kinds, " ")
  split("p50 p99 p99.9", quantiles, " ")
  for (s = 1; s <= 2; ++s) for (k = 1; k <= 3; ++k) for (q = 1; q <= 3; ++q) {
    name = kinds[k] "_" quantiles[q]
    latency(kinds[k] " " scenarios[s] (s == 2 ? " " clients : "") " " quantiles[q], scenarios[s], name, s == 2 && name == "state_p99" ? 5000 : 0)
  }
  latency("fresh state after a cut p50", "cut", "fresh_p50", 0)
  latency("fresh state after a cut p99", "cut", "fresh_p99", 0)
  cost("each of " few " clients: processor", "ms/s", "few", few, "host_cpu_percent", 10)
  cost("each of " clients " clients: processor", "ms/s", "beside", clients, "host_cpu_percent", 10)
  cost("each of " few " clients: memory", "KiB", "few", few, "host_resident_kib", 1)
  cost("each of " clients " clients: memory", "KiB", "beside", clients, "host_resident_kib", 1)
  delivered("each client: bytes", "kB/s", "client_bytes_per_s", 0.001)
  delivered("each client: images", "1/s", "client_images_per_s", 1)
  memory = one(0, "seeker", "crowd", "host_resident_kib") / 1024
  grpc_memory = one(0, "grpc", "crowd", "host_resident_kib")
  row("memory with " crowd " clients", "MiB", memory, grpc_memory == "" ? "" : grpc_memory / 1024, grpc_memory > 0 ? 1024 * memory / grpc_memory : "", "<= 256", memory > 256)
  delivered("robot's process: waited", "%", "host_waited_percent", 1)
  map_rows("idle")
  map_rows("mapping")
  printf "{\n  \"pairs\": %d,\n  \"clients\": %d,\n  \"rows\": [\n%s\n  ]\n}\n", pairs, clients, rows > json
  exit missed > 0
}
