#!/bin/sh
# The estimate of a picture's error, which looks at some pixels, beside the largest error of all of them.
# Usage: estimate_whole.sh PROGRAM "PATH OPTIONS..." ...     one line for each picture; slow, since the reference draws it
set -eu
program=$1
shift
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
number() { sed -n "s/.*\"$1\":[[:space:]]*\([0-9.e+-]*\).*/\1/p" "$2" | head -1; }
printf '%10s %10s %6s %8s  %s\n' estimate "max of all" ratio pixels picture
for picture in "$@"; do
    # shellcheck disable=SC2086
    "$program" render $picture --background 0,0,0,0 --quiet -o "$folder/a.exr" --json "$folder/a.json"
    # shellcheck disable=SC2086
    "$program" render $picture --background 0,0,0,0 --quiet -o "$folder/b.exr" --method reference
    "$program" check "$folder/a.exr" "$folder/b.exr" --threshold 255 --json >"$folder/c.json"
    estimate=$(number estimate "$folder/a.json")
    most=$(number max "$folder/c.json")
    echo "$estimate $most $(number pixels "$folder/a.json") $picture" |
        awk '{ e = $1; m = $2; p = $3; $1 = $2 = $3 = ""; printf "%10.3f %10.3f %6.2f %8d  %s\n", e, m, e / m, p, $0 }'
done
