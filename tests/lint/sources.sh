# shellcheck shell=bash
# sources EXTENSION...: our own files with one of the endings, one a line. Sourced.
sources() {
  local patterns=("${@/#/*.}") names=() extension
  if git ls-files -- "${patterns[@]}" 2>/dev/null | grep -q .; then
    # New files count before they are added; deleted ones no longer do.
    git ls-files --cached --others --exclude-standard -- "${patterns[@]}" | sort -u |
      while read -r file; do if [[ -e $file ]]; then echo "$file"; fi; done
    return
  fi
  for extension in "$@"; do
    names+=(-o -name "*.$extension")
  done
  find . \( -path ./build -o -path ./out -o -path ./.git \) -prune -o -type f \( "${names[@]:1}" \) -print | sed 's|^\./||' | sort
}
