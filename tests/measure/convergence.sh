#!/bin/bash
# Error of methods against the reference over the step, in levels of 255 on float pictures before the background, with the
# order between successive steps, as rows of a Markdown table; every mode, in perspective and in parallel projection.
# Usage: [VALUES="options for minip and mean"] [PROJECTIONS="perspective parallel"] convergence.sh PROGRAM METHODS PATH
# [render options], e.g. convergence.sh build/angioscope "singlepass slicing" demo/phantom --preset cta-head --size 192x192
# VALUES names a preset whose window, and a clip box whose inside, make those two modes show something; a reference that is
# all one grey is refused, since it would prove nothing.
set -euo pipefail
program=$1 methods=$2 path=$3
shift 3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
picture() { "$program" render "$path" --background 0,0,0,0 --no-termination "$@" 2>"$work/said"; }
order() { [ -n "$1" ] && awk -v a="$1" -v b="$2" 'BEGIN { if (b > 0) printf "%.2f", log(a / b) / log(2); else printf "-" }' || printf -- -; }
echo '| method | projection | scene | step | max | 99.9 % | RMS | flipped | order max | order RMS |'
echo '|---|---|---|---|---|---|---|---|---|---|'
for projection in ${PROJECTIONS:-perspective parallel}; do
    for scene in "dvr none" "dvr phong" "mip none" "minip none" "mean none" "iso phong"; do
        read -r mode shading <<<"$scene"
        extra=()
        case $mode in minip | mean) read -r -a extra <<<"${VALUES:-}" ;; esac
        common=("$@" "${extra[@]}" --mode "$mode" --shading "$shading" --projection "$projection")
        picture "${common[@]}" --method reference -o "$work/ref.exr"
        if grep -qE 'all one grey|is empty' "$work/said"; then
            echo "| - | $projection | $scene | - | nothing to compare: $(grep -oE 'all one grey|is empty' "$work/said" | head -1) |||||||"
            continue
        fi
        for method in $methods; do
            before_max="" before_rms=""
            for step in 1 0.5 0.25 0.125; do
                picture "${common[@]}" --method "$method" --step "$step" -o "$work/a.exr"
                json=$("$program" check "$work/a.exr" "$work/ref.exr" --threshold 255 --json)
                field() { sed -E "s/.*\"$1\":([^,}]*).*/\1/" <<<"$json"; }
                max=$(field max) rms=$(field rms)
                printf '| %s | %s | %s | %s | %.4g | %.4g | %.4g | %.2g | %s | %s |\n' "$method" "$projection" "$scene" "$step" \
                    "$max" "$(field p999)" "$rms" "$(field flipped)" "$(order "$before_max" "$max")" "$(order "$before_rms" "$rms")"
                before_max=$max before_rms=$rms
            done
        done
    done
done
