# Reads ctest's JUnit report: the skipped tests with their reasons, the failed ones, and how many there were.
function plain(text) {
  gsub(/&lt;/, "<", text); gsub(/&gt;/, ">", text); gsub(/&quot;/, "\"", text); gsub(/&apos;/, "'", text)
  gsub(/&#[^;]*;/, " ", text); gsub(/&amp;/, "\\&", text)
  return text
}
/<testcase / {
  match($0, / name="[^"]*"/); name = plain(substr($0, RSTART + 7, RLENGTH - 8))
  match($0, / status="[^"]*"/); status = substr($0, RSTART + 9, RLENGTH - 10)
  reason = ""; take = 0; count[status]++
  if (status == "fail") failed = failed "  " name "\n"
}
# GoogleTest prints "file:line: Skipped" and the reason on the next line.
take { reason = plain($0); take = 0 }
/: Skipped$/ && reason == "" { take = 1 }
/<\/testcase>/ && status == "notrun" { skipped = skipped "  " name ": " (reason == "" ? "no reason given" : reason) "\n" }
END {
  if (skipped != "") printf "\nskipped:\n%s", skipped
  if (failed != "") printf "\nfailed:\n%s", failed
  printf "\n%d passed, %d failed, %d skipped\n", count["run"], count["fail"], count["notrun"] + count["disabled"]
}
