#!/usr/bin/env bash
# The version of each library and tool that the project is built and tested with, in Debian's suites, as a table of Markdown.
#   scripts/dependency_versions.sh SUITE...      such as: bookworm trixie
# Reads the suites' package lists from OSTEOMILL_MIRROR (http://deb.debian.org/debian); installs nothing and needs no root.
set -euo pipefail
[ $# -gt 0 ] || { sed -n '2,/^set/{/^#/p}' "$0" >&2; exit 2; }
cd "$(dirname "$0")/.."
mapfile -t packages < <(grep -hv '^#' scripts/packages.txt scripts/test_packages.txt)

apt=$(mktemp -d)
trap 'rm -rf "$apt"' EXIT
declare -A version
for suite; do
    mkdir -p "$apt/$suite"/{lists/partial,cache}
    echo "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] ${OSTEOMILL_MIRROR:-http://deb.debian.org/debian} $suite main" >"$apt/$suite/sources.list"
    here=(-o Dir::Etc::sourcelist="$apt/$suite/sources.list" -o Dir::Etc::sourceparts=- -o Dir::State::lists="$apt/$suite/lists"
          -o Dir::State::status=/dev/null -o Dir::Cache="$apt/$suite/cache" -o Debug::NoLocking=1 -o APT::Sandbox::User=)
    apt-get "${here[@]}" update -qq
    while read -r package full; do
        # Without epoch, Debian's revision, and its mark of omitted sources: 1:2.2.4+ds-1 is 2.2.4.
        version[$suite $package]=$(sed -E 's/^[0-9]+://; s/-[^-]*$//; s/[+~](dfsg|ds|deb|b[0-9]).*//' <<<"$full")
    done < <(apt-cache "${here[@]}" show --no-all-versions "${packages[@]}" | awk '/^Package:/ { name = $2 } /^Version:/ { print name, $2 }')
done
row() { printf '|'; printf ' %s |' "$@"; echo; }
row package "$@"
printf '|'; printf -- '---|%.0s' package "$@"; echo
for package in "${packages[@]}"; do
    cells=()
    for suite; do cells+=("${version[$suite $package]:-none}"); done
    row "\`$package\`" "${cells[@]}"
done
