#!/usr/bin/env bash
# new_choice.sh COMPILER FLAGS...: adds one value to each enumeration from which a user chooses, in a copy of its header. The
# compiler must then report every source that must define the meaning of the new value. A value without a word cannot be chosen
# (pipeline/base/words.h).
set -euo pipefail
cd "$(dirname "$0")/.."
compile=("$@")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failed=0

# forgets HEADER ENUMERATION FILES...: with one more value in ENUMERATION, each of FILES must contain a switch that does not
# compile.
forgets() {
  local header=$1 enumeration=$2 file found
  shift 2
  rm -rf "$scratch/tree" && mkdir -p "$scratch/tree/$(dirname "$header")"
  sed -E "s/^( *)enum class $enumeration \{ ([^}]*) \}/\1enum class $enumeration { \2, forgotten }/" \
    "$header" > "$scratch/tree/$header"
  cmp -s "$header" "$scratch/tree/$header" && { echo "$header has no enumeration $enumeration in one line"; failed=1; return; }
  for file in "$@"; do
    "${compile[@]}" -I"$scratch/tree" -I. -x c++ -fsyntax-only "$file" 2>"$scratch/words" && true
    found=$(grep -cE "^${file//./\\.}:[0-9]+:[0-9]+: error: enumeration value .forgotten. not handled" "$scratch/words" || true)
    if [ "$found" -eq 0 ]; then
      echo "$enumeration: $file would not notice a new value"; cat "$scratch/words"; failed=1
    fi
  done
}

forgets pipeline/job/fatigue.h MeanStress fatigue/damage.cpp fatigue/strain_life.cpp
forgets pipeline/job/fatigue.h MeanStressRelaxation fatigue/relaxation.cpp
exit $failed
