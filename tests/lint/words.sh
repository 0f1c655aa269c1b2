#!/usr/bin/env bash
# Words that docs/glossary.md lists in its column "instead of", in backquotes: none may be a part of an identifier in a
# public header, and none that is not marked "(in names)" may stand in a /// comment there. Prints every breach as
# file:line and fails if there is one.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/lint/sources.sh

readonly GLOSSARY=docs/glossary.md

mapfile -t headers < <(sources hpp | grep -E '^(common|client|server)/')

awk -v glossary="$GLOSSARY" '
  # One row of the glossary: its last column, and there each word in backquotes with what follows it.
  function read_row(row, columns, count, words, pieces, i, word) {
    count = split(row, columns, "|")
    words = columns[count - 1]
    pieces = split(words, piece, "`")
    for (i = 2; i <= pieces; i += 2) {
      word = tolower(piece[i])
      names[word] = 1
      if (i == pieces || piece[i + 1] !~ /^ *\(in names\)/) comments[word] = 1
    }
  }

  # "HTMRotateBack_m" -> " htm rotate back m "
  function parts_of(text, spaced) {
    spaced = ""
    while (match(text, /[a-z0-9][A-Z]|[A-Z][A-Z][a-z]/)) {
      spaced = spaced substr(text, 1, RSTART) " "
      text = substr(text, RSTART + 1)
    }
    spaced = spaced text
    gsub(/[^A-Za-z0-9]+/, " ", spaced)
    return " " tolower(spaced) " "
  }

  function plain(text) {
    gsub(/[^A-Za-z0-9]+/, " ", text)
    return " " tolower(text) " "
  }

  function check(text, words, where, word) {
    for (word in words) {
      if (index(text, " " word " ")) {
        printf "%s:%d: \"%s\" in %s (docs/glossary.md)\n", FILENAME, FNR, word, where
        found = 1
      }
    }
  }

  BEGIN {
    while ((getline row < glossary) > 0) {
      if (row ~ /^\|.*\| *instead of *\|$/) { in_table = 1; continue }
      if (in_table && row ~ /^\|/) read_row(row)
    }
    for (word in names) any = 1
    if (!any) { print glossary ": no words in the column \"instead of\""; found = 1; exit 1 }
  }

  FNR == 1 { in_block = 0 }
  {
    code = $0
    comment = ""
    gsub(/"([^"\\]|\\.)*"/, "\"\"", code)  # neither strings nor paths of includes
    if (in_block) {
      if (!match(code, /\*\//)) next
      code = substr(code, RSTART + 2)
      in_block = 0
    }
    if (at = index(code, "//")) {
      comment = substr(code, at)
      code = substr(code, 1, at - 1)
    }
    if (match(code, /\/\*/)) {
      rest = substr(code, RSTART + 2)
      code = substr(code, 1, RSTART - 1)
      if (match(rest, /\*\//)) code = code " " substr(rest, RSTART + 2)
      else in_block = 1
    }
    if (code ~ /^ *#/) code = ""
    if (code ~ /[A-Za-z]/) check(parts_of(code), names, "a name")
    if (comment ~ /^\/\/\//) check(plain(comment), comments, "a comment")
  }
  END { exit found }
' "${headers[@]}"
