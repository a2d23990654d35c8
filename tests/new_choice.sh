#!/usr/bin/env bash
# new_choice.sh COMPILER FLAGS...: adds one value to each enumeration that a user chooses from, in a copy of its
# header, and expects the compiler to name every place that would have to say what the new value means.
set -euo pipefail
cd "$(dirname "$0")/.."
compile=("$@")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failed=0

# forgets HEADER ENUMERATION PLACES FILES...: with one more value in ENUMERATION, HEADER holds PLACES switches that do not
# compile, and each of FILES at least one.
forgets() {
  local header=$1 enumeration=$2 places=$3 file found
  shift 3
  rm -rf "$scratch/tree" && mkdir -p "$scratch/tree/$(dirname "$header")"
  sed -E "s/^( *)enum class $enumeration \{ ([^}]*) \}/\1enum class $enumeration { \2, forgotten }/" \
    "$header" > "$scratch/tree/$header"
  cmp -s "$header" "$scratch/tree/$header" && { echo "$header has no enumeration $enumeration in one line"; failed=1; return; }
  for file in "$scratch/tree/$header" "$@"; do
    "${compile[@]}" -I"$scratch/tree" -I. -x c++ -fsyntax-only "$file" 2>"$scratch/words" && true
    found=$(grep -cE "^${file//./\\.}:[0-9]+:[0-9]+: error: enumeration value .forgotten. not handled" "$scratch/words" || true)
    if [ "$file" = "$scratch/tree/$header" ] && [ "$found" -ne "$places" ]; then
      echo "$enumeration: $found places of $header would notice a new value, not $places"; failed=1
    elif [ "$found" -eq 0 ]; then
      echo "$enumeration: $file would not notice a new value"; cat "$scratch/words"; failed=1
    fi
  done
}

forgets pipeline/job/fatigue.h MeanStress 1 fatigue/damage.cpp fatigue/strain_life.cpp
forgets pipeline/job/fatigue.h MeanStressRelaxation 1 fatigue/relaxation.cpp
forgets pipeline/job/fatigue.h Stress 2
forgets pipeline/job/fatigue.h Counting 2
forgets pipeline/job/strain.h DeformationMeasure 2
forgets pipeline/job/kinematics.h Kinematics 2
forgets pipeline/job/strain.h Slip 3
forgets pipeline/job/strain.h Equivalent 3
forgets pipeline/job/dresspack.h Hand 2
forgets pipeline/job/routing.h ToolEnd 2
forgets pipeline/job/motion.h PathKind 3
exit $failed
