#!/bin/sh
# Installs the build into a folder of its own, moves that elsewhere, and tries all that was installed: the program with its
# presets and modules, the manual page, completions in every shell that is here, and the library by the example in docs/.
# Usage: install.sh SOURCE_FOLDER BUILD_FOLDER [FLAGS FOR THE COMPILER]
set -eu
source=$1
build=$2
flags=${3:-}
scripts=$source/tests/install
stage=$build/tests/stage
failed=0
complain() {
    echo "failed: $*"
    failed=1
}

rm -rf "$stage"
DESTDIR="$stage/first" cmake --install "$build" --prefix /some/where >/dev/null
mkdir -p "$stage/home" "$stage/options"
mv "$stage/first/some/where" "$stage/second"
root=$stage/second
# No settings of whoever runs this, and nothing of the build's.
program() { env -i HOME="$stage/home" PATH=/usr/bin:/bin ASAN_OPTIONS=detect_leaks=0 "$root/bin/angioscope" "$@"; }

for file in share/doc/angioscope/LICENSE share/doc/angioscope/viewer.md share/doc/angioscope/examples/example.c; do
    [ -s "$root/$file" ] || complain "$file is not installed"
done

# The program, with what lies beside it.
program presets list >"$stage/presets.txt"
for preset in "$source"/presets/*.json; do
    grep -q "^$(basename "$preset" .json) " "$stage/presets.txt" || complain "$(basename "$preset") is not found"
done
if grep -q '^ANG_WITH_GDCM:BOOL=ON' "$build/CMakeCache.txt"; then
    program phantom -o "$stage/phantom" --dims 96x96x96 --quiet || complain "no phantom is written"
    program render "$stage/phantom" -o "$stage/program.ppm" --preset ct-skin --method cpu --size 512x512 --quiet ||
        complain "no picture is drawn"
    if grep -q '^ANG_WITH_OIIO:BOOL=ON' "$build/CMakeCache.txt"; then
        program render "$stage/phantom" -o "$stage/program.tif" --size 32x32 --quiet || complain "no TIFF is written"
    fi
fi

if grep -q '^ANG_WITH_OPENCV:BOOL=ON' "$build/CMakeCache.txt" && [ -d "$stage/phantom" ]; then
    program render "$stage/phantom" -o "$stage/film.avi" --size 32x32 --frames 2 --orbit 9 --quiet || complain "no film is written"
fi

# The manual page and the completions name every verb and option that the program knows.
gzip -dc "$root/share/man/man1/angioscope.1.gz" >"$stage/angioscope.1"
sed 's/\\%//g; s/\\-/-/g; s/\\f[BIR]//g' "$stage/angioscope.1" >"$stage/manual.txt"
verbs=$(sed -n 's/^\.SS //p' "$stage/manual.txt")
[ "$(echo "$verbs" | wc -w)" -ge 8 ] || complain "the manual page has only these verbs: $verbs"
for verb in $verbs; do
    program --help | grep -q "angioscope \[*$verb" || complain "$verb is no verb of the program"
    names=$(program "$verb" --help | sed -n 's/^  \(-[a-z], \|    \)\(--[a-z-]*\).*/\2/p' | sort -u)
    [ -n "$names" ] || complain "$verb has no options"
    echo "$names" >"$stage/options/$verb"
    for name in $names; do
        awk -v verb="$verb" '/^\.S/ { inside = $0 == ".SS " verb } inside' "$stage/manual.txt" |
            grep -qE -e "^$name[.,]\$" || complain "the manual page's $verb has no $name"
        sed -n '/^.SH OPTIONS/,/^.SH EXIT/p' "$stage/manual.txt" | grep -qE -e "(^|, )$name( |\$)" ||
            complain "the manual page does not describe $name"
    done
done
for code in 0 1 2 3 4 5 6 7 130; do
    grep -q "^$code\$" "$stage/manual.txt" || complain "the manual page does not say what exit code $code means"
done
if command -v man >/dev/null 2>&1; then
    said=$(MANWIDTH=100 man --warnings -l "$stage/angioscope.1" 2>&1 >"$stage/page.txt" || echo "man fails")
    [ -z "$said" ] || complain "man says: $said"
    grep -q 'angioscope render PATH -o OUT.png' "$stage/page.txt" || complain "the manual page shows no synopsis"
else
    echo "man is not installed: the page is not shown"
fi
if command -v mandoc >/dev/null 2>&1; then
    said=$(mandoc -Tlint -Wwarning "$stage/angioscope.1" | grep -v 'STYLE:' || true)
    [ -z "$said" ] || complain "mandoc says: $said"
fi
for shell in bash zsh fish; do
    if ! command -v $shell >/dev/null 2>&1; then
        echo "$shell is not installed: its completion is not tried"
        continue
    fi
    arguments=""
    [ $shell = fish ] && arguments=--no-config
    [ $shell = zsh ] && arguments=-f
    (cd "$stage" && env HOME="$stage/home" PATH="$root/bin:$PATH" ASAN_OPTIONS=detect_leaks=0 \
        $shell $arguments "$scripts/completion.$shell" "$root/share" "$stage") || complain "completion in $shell"
done

# The library, as others build with it.
PKG_CONFIG_PATH=$root/lib/pkgconfig
export PKG_CONFIG_PATH
compile() { ${CC:-cc} -std=c17 -Wall -Wextra -Werror "$@"; }
# shellcheck disable=SC2046
for header in $(cd "$root/include/angioscope" && find . -name '*.h' | sed 's|^\./||'); do
    echo "#include \"$header\"" >"$stage/header.c"
    compile -fsyntax-only "$stage/header.c" $(pkg-config --cflags angioscope) || complain "$header cannot be included alone"
done
# shellcheck disable=SC2046,SC2086
compile $flags "$root/share/doc/angioscope/examples/example.c" $(pkg-config --cflags --libs angioscope) -o "$stage/example" ||
    complain "the example cannot be built"
ASAN_OPTIONS=detect_leaks=0 "$stage/example" >"$stage/example.ppm" || complain "the example fails"
[ "$(wc -l <"$source/docs/example.c")" -le 30 ] || complain "the example is longer than 30 lines"
[ ! -f "$stage/program.ppm" ] || cmp "$stage/example.ppm" "$stage/program.ppm" ||
    complain "the example's picture is not the program's"
strings=$(head -c 15 "$stage/example.ppm" | tr '\n' ' ')
case $strings in "P6 512 512 255 "*) ;; *) complain "the example's picture begins with $strings" ;; esac
exit $failed
