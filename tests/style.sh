#!/bin/sh
# The house rules that a script can see: direction of imports, where OpenGL and C++ live, length of files, formatting.
# Usage: style.sh SOURCE_FOLDER
set -eu
cd "$1"
failed=0
complain() {
    echo "$1:"
    echo "$2" | sed 's/^/  /'
    failed=1
}
found=$(grep -rnE '#include "(io|ui|app)/' core || true)
[ -z "$found" ] || complain "core includes what it must not" "$found"
found=$(grep -rnE '#include "(ui|app)/' io || true)
[ -z "$found" ] || complain "io includes what it must not" "$found"
found=$(grep -rnE '#include "(io|app)/' ui || true)
[ -z "$found" ] || complain "ui includes what it must not" "$found"
found=$(grep -rnE '#include "ui/(actions|dialogs|host|panels|panes|[a-z_]+\.h)' ui/state ui/toolkit | grep -vF '"ui/gui.h"' || true)
[ -z "$found" ] || complain "ui/state and ui/toolkit know nothing of the viewer" "$found"
found=$(grep -rlE 'glad/gl\.h|\bgl[A-Z][A-Za-z]+\(' core io ui app --include=*.c --include=*.h | grep -v '^core/render/' || true)
[ -z "$found" ] || complain "OpenGL outside core/render" "$found"
found=$(grep -rnE '\b(printf|puts|putchar|perror|exit|abort)\(|fputs\(.*std|fprintf\(std' core io ui --include=*.c --include=*.cpp |
    grep -v '^io/sandbox/worker_main.c' || true) # a program of its own
[ -z "$found" ] || complain "core, io and ui neither print nor exit" "$found"
found=$(find app core io ui shaders tests -type f \( -name '*.c' -o -name '*.h' -o -name '*.cpp' -o -name '*.glsl' \) -exec wc -l {} + |
    awk '$2 != "total" && $1 > 600 { print $2 ": " $1 " lines" }')
[ -z "$found" ] || complain "files over 600 lines" "$found"
if command -v clang-format >/dev/null 2>&1; then
    found=$(find app core io ui tests -name '*.c' -o -name '*.h' -o -name '*.cpp' | xargs clang-format --dry-run 2>&1 |
        grep -E 'warning:' | cut -d: -f1 | sort -u || true)
    [ -z "$found" ] || complain "not formatted (make format)" "$found"
elif [ -n "${CI:-}" ]; then
    complain "clang-format is not installed" "continuous integration must check formatting"
else
    echo "clang-format is not installed: formatting is not checked"
fi
exit $failed
