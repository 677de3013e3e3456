#!/usr/bin/env bash
# Whether the packages of what is committed are the same bytes again, built in another folder, by another user where that can be (as
# root), with another umask, time zone, locale and number of jobs, without a compiler's cache, and later. Takes as long as two builds.
#   scripts/reproduce_packages.sh [--cached] [FOLDER]      compares with packages of this commit in FOLDER (out/packages/SUITE), or
#                                                          builds them first
#   --cached    takes what was compiled from the cache (CMAKE_CXX_COMPILER_LAUNCHER=ccache): minutes, but blind to what compiling differs in
set -euo pipefail
cd "$(dirname "$0")/.."
cache=CCACHE_DISABLE=1
if [ "${1:-}" = --cached ]; then cache=CCACHE_READONLY=1; shift; fi
. scripts/debian_suite.sh
first=$(realpath -m "${1:-out/packages/$suite}")
[ "$(cat "$first/commit" 2>/dev/null)" = "$(git rev-parse HEAD)" ] || scripts/package.sh "$first" >/dev/null

elsewhere=$(mktemp -d -p /var/tmp a-rather-different-folder.XXXXXX)
trap 'rm -rf "$elsewhere"' EXIT
git clone --quiet . "$elsewhere/source"
mkdir "$elsewhere/tmp"
as=()
if [ "$(id -u)" -eq 0 ]; then
    chown -R nobody:nogroup "$elsewhere"
    as=(setpriv --reuid=nobody --regid=nogroup --clear-groups)
fi
umask 027
"${as[@]}" env --chdir="$elsewhere/source" HOME="$elsewhere" TMPDIR="$elsewhere/tmp" TZ=Pacific/Kiritimati LC_ALL=C LANG=C \
    JOBS="${JOBS:-1}" "$cache" GIT_CONFIG_COUNT=1 GIT_CONFIG_KEY_0=safe.directory GIT_CONFIG_VALUE_0='*' \
    scripts/package.sh "$elsewhere/packages" >/dev/null

differ=0
for package in "$first"/*.{deb,tar.xz,whl,spdx.json}; do
    again=$elsewhere/packages/$(basename "$package")
    if cmp -s "$package" "$again"; then
        echo "same       $(basename "$package")"
        continue
    fi
    echo "different  $(basename "$package")"
    differ=1
    if command -v diffoscope >/dev/null; then diffoscope --max-report-size 20000 "$package" "$again" || true; fi
done
exit $differ
