# Makes a manual page of what collect.sh prints. Variables: program, version.

function roff(text) {
  gsub(/\\/, "\\e", text)
  gsub(/-/, "\\-", text)
  return text ~ /^[.']/ ? "\\&" text : text
}

function paragraph(text) { print ".PP"; print roff(text) }

# What is said of a program or a verb before its options.
function introduce(text) {
  if (verb != "") { print roff(text); return }
  if (!named) {
    sub("^" program ": ", "", text)
    sub(/\.$/, "", text)
    print ".SH NAME\n" roff(program) " \\- " roff(text)
    named = 1
    return
  }
  described[++lines] = text
}

function synopsis(usage) {
  sub(/^Usage: [^ ]* /, "", usage)
  if (verb != "") { sub("^" verb " ", "", usage); print ".PP\n.B " roff(program " " verb) "\n" roff(usage); return }
  print ".SH SYNOPSIS\n.B " roff(program) "\n" roff(usage)
  if (lines) print ".SH DESCRIPTION"
  for (i = 1; i <= lines; i++) { print roff(described[i]); print ".br" }
}

# "  --name TEXT   text": name and text are two or more blanks apart, or the text is in the next line.
function entry(line,   parts) {
  sub(/^  /, "", line)
  sub(/^-[a-z],/, "& ", line)
  parts = match(line, /[^ ,]   *[^ ]/)
  print ".TP\n.B " roff(parts ? substr(line, 1, parts) : line)
  if (parts) { line = substr(line, parts + 1); sub(/^ */, "", line); print roff(line) }
}

BEGIN { printf ".TH %s 1 \"\" \"Seeker %s\" \"Seeker\"\n", toupper(program), version }

/^@ / {
  verb = substr($0, 3); section = "introduction"
  if (verb != "") { if (!headed++) print ".SH VERBS"; print ".SS " roff(program " " verb) }
  next
}
/^Usage: / { synopsis($0); section = "options"; next }
section == "introduction" { if ($0 != "") introduce($0); next }
# Verbs have sections of their own below.
/^Subcommands:$/ { section = "verbs"; next }
/^(Options|Positionals):$/ { section = "options"; if (verb == "" && !optioned++) print ".SH OPTIONS"; next }
/^[^ ]/ { section = "remarks"; paragraph($0); next }
section == "verbs" || $0 == "" { next }
section == "remarks" { sub(/^ +/, ""); print ".br\n" roff($0); next }
/^  -h,--help/ && verb != "" { next }
/^  [^ ]/ { entry($0); next }
{ sub(/^ +/, ""); print roff($0) }
