#!/bin/sh
# Installs the Debian packages that are missing, saying which; elsewhere names them and stops.
set -eu
missing=""
if command -v dpkg-query >/dev/null 2>&1; then
    for package in "$@"; do
        status=$(dpkg-query -W -f '${Status}' "$package" 2>/dev/null || true)
        [ "$status" = "install ok installed" ] || missing="$missing $package"
    done
    [ -n "$missing" ] || exit 0
fi
id=$(. /etc/os-release 2>/dev/null && echo "${ID:-unknown}-${VERSION_ID:-}") || id=unknown
if [ "$id" != "debian-12" ]; then
    echo "This is $id; Angioscope is built on Debian 12. Install what matches these Debian packages:" >&2
    echo "  ${missing:-$*}" >&2
    echo "then build with: cmake --preset default && cmake --build --preset default" >&2
    exit 1
fi
echo "Installing:$missing"
run=""
[ "$(id -u)" -eq 0 ] || run="sudo"
$run apt-get update -qq
# shellcheck disable=SC2086
$run env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing >/dev/null
