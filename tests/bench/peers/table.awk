# The rows of peers.sh as a table: the figures, then Seeker's in proportion to each peer's.
BEGIN {
  FS = "\t"
  printf "%-6s %-22s %8s %9s %9s %8s %16s %8s %8s\n", "log", "program", "wall s", "ms/scan", "p99 ms", "MB", "error m", "median", "deg"
}
{
  printf "%-6s %-22s %8.2f %9.3f %9.3f %8.1f %7.4f +- %5.3f %8.4f %8.2f\n", $1, $2, $3, $4, $5, $6, $7, $8, $9, $10
  for (k = 1; k <= NF; ++k) value[NR, k] = $k
}
END {
  printf "\n%-6s %-45s %8s %9s %9s %8s %8s %8s %8s\n", "log", "ratio", "wall", "ms/scan", "p99", "memory", "error", "median", "deg"
  for (a = 1; a <= NR; ++a) {
    for (b = 1; b <= NR; ++b) {
      if (value[a, 1] != value[b, 1] || value[a, 2] !~ /^seeker/ || value[b, 2] ~ /^seeker/) continue
      printf "%-6s %-45s", value[a, 1], value[a, 2] " / " value[b, 2]
      split("3 4 5 6 7 9 10", columns, " ")
      for (k = 1; k <= 7; ++k) {
        divisor = value[b, columns[k]]
        ratio = divisor > 0 ? sprintf("%.3f", value[a, columns[k]] / divisor) : "-"
        printf((k == 2 || k == 3) ? " %9s" : " %8s", ratio)
      }
      printf "\n"
    }
  }
}
