# The rows of peers.sh as a table: the figures, then Seeker's in proportion to each peer's.
BEGIN {
  FS = "\t"
  printf("%-6s %-22s %8s %11s %9s %9s %8s %17s %8s %8s\n", "log", "program", "wall s", "processor s", "ms/scan", "p99 ms", "MB",
         "error m", "median", "deg")
}
{
  printf("%-6s %-22s %8.2f %11.2f %9.3f %9.3f %8.1f %7.4f +- %6.4f %8.4f %8.2f\n", $1, $2, $3, $4, $5, $6, $7, $8, $9, $10, $11)
  for (k = 1; k <= NF; ++k) value[NR, k] = $k
}
END {
  columns = split("3 4 5 6 7 8 10 11", column, " ")
  printf("\n%-6s %-40s %9s %9s %9s %9s %9s %9s %9s %9s\n", "log", "ratio", "wall", "processor", "ms/scan", "p99", "memory",
         "error", "median", "deg")
  for (a = 1; a <= NR; ++a) {
    for (b = 1; b <= NR; ++b) {
      if (value[a, 1] != value[b, 1] || value[a, 2] !~ /^seeker/ || value[b, 2] ~ /^seeker/) continue
      printf("%-6s %-40s", value[a, 1], value[a, 2] " / " value[b, 2])
      for (k = 1; k <= columns; ++k) {
        divisor = value[b, column[k]]
        ratio = divisor > 0 ? sprintf("%.3f", value[a, column[k]] / divisor) : "-"
        printf(" %9s", ratio)
      }
      printf("\n")
    }
  }
}
