#!/usr/bin/env bash
# unreached.sh PROGRAM... -- LIBRARY...: prints every public function of the libraries that is in no program. Programs are
# linked without the functions that nothing in them refers to, directly or through others (--gc-sections), so that what
# only tests and benchmarks call is not in them. Exceptions: unreached.txt, a name and its reason on each line.
# Fails if there is a function without an exception, or an exception for one that is not there. An exception may be needed
# in one kind of build only: where the compiler puts a function into all its callers, nothing refers to it.
set -euo pipefail
here=$(dirname "${BASH_SOURCE[0]}")

programs=()
while (($#)) && [[ $1 != -- ]]; do
  programs+=("$1")
  shift
done
shift
libraries=("$@")
((${#programs[@]} && ${#libraries[@]})) || { echo "usage: unreached.sh PROGRAM... -- LIBRARY..." >&2; exit 2; }

# functions KINDS FILE...: names of the functions that nm marks with one of the letters. The clones and parts into which
# the compiler cuts a function ([clone ...]), and destructors, which come with their class, are not functions of their own.
functions() {
  nm --defined-only "${@:2}" 2>/dev/null | awk -v kinds="$1" 'index(kinds, $2) {print $3}' | c++filt |
    grep -v '\[clone\|::~' | sort -u
}

# T: with external linkage. The linker makes them local (t) in a program.
public=$(functions T "${libraries[@]}")
unreached=$(comm -23 <(echo "$public") <(functions Tt "${programs[@]}"))
exceptions=$(sed -e '/^#/d' -e '/^$/d' -e 's/ *|.*//' "$here/unreached.txt" | sort -u)
code=0
while read -r name; do
  [[ -z $name ]] || { echo "no program reaches $name"; code=1; }
done < <(comm -23 <(echo "$unreached") <(echo "$exceptions"))
while read -r name; do
  [[ -z $name ]] || { echo "unreached.txt names $name, which is not there"; code=1; }
done < <(comm -13 <(echo "$public") <(echo "$exceptions"))
exit "$code"
