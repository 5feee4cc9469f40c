#!/bin/bash
# Error of a method against the reference over the step, in levels of 255 on float pictures before the background, with
# the order between successive steps. Usage: convergence.sh PROGRAM METHOD PATH [render options]
# e.g. convergence.sh build/angioscope singlepass demo/phantom --preset cta-head --size 256x256
set -euo pipefail
program=$1 method=$2 path=$3
shift 3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
picture() { "$program" render "$path" --quiet --background 0,0,0,0 --no-termination "$@"; }
printf '%-26s %-6s %10s %10s %10s %9s %7s %7s\n' scene step max p99.9 rms flipped order-m order-r
for scene in "dvr none" "dvr phong" "mip none" "minip none" "mean none" "iso phong"; do
    read -r mode shading <<<"$scene"
    picture "${@}" --mode "$mode" --shading "$shading" --method reference -o "$work/ref.exr"
    before_max="" before_rms=""
    for step in 1 0.5 0.25 0.125; do
        picture "${@}" --mode "$mode" --shading "$shading" --method "$method" --step "$step" -o "$work/a.exr"
        json=$("$program" check "$work/a.exr" "$work/ref.exr" --threshold 255 --json)
        field() { sed -E "s/.*\"$1\":([^,}]*).*/\1/" <<<"$json"; }
        max=$(field max) rms=$(field rms)
        order() { [ -n "$1" ] && awk -v a="$1" -v b="$2" 'BEGIN { if (b > 0) printf "%.2f", log(a / b) / log(2); else printf "-" }' || printf -- -; }
        printf '%-26s %-6s %10.4g %10.4g %10.4g %9.2g %7s %7s\n' "$mode $shading" "$step" "$max" "$(field p999)" "$rms" \
            "$(field flipped)" "$(order "$before_max" "$max")" "$(order "$before_rms" "$rms")"
        before_max=$max before_rms=$rms
    done
done
