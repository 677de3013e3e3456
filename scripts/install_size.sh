#!/usr/bin/env bash
# The size of packages on a bare Debian, with all that they need: how many, megabytes to fetch and on the disk.
#   scripts/install_size.sh LIST_OR_PACKAGE...     such as: scripts/packages.txt libinsighttoolkit5-dev
set -euo pipefail

# Names of all that would be installed where nothing is.
closure() {
    apt-get -o Dir::State::status=/dev/null --simulate --no-install-recommends install "$@" |
        sed -n 's/^Inst \([^ ]*\).*/\1/p' | sort -u
}

wanted=()
for each in "$@"; do
    if [ -f "$each" ]; then
        mapfile -t -O "${#wanted[@]}" wanted < <(grep -v '^#' "$each")
    else
        wanted+=("$each")
    fi
done
[ ${#wanted[@]} -gt 0 ] || { sed -n '2,3s/^# //p' "$0" >&2; exit 2; }
comm -23 <(closure "${wanted[@]}" apt '?essential') <(closure apt '?essential') |
    xargs apt-cache show --no-all-versions |
    awk '/^Size:/ { fetched += $2; ++count }
         /^Installed-Size:/ { installed += 1024 * $2 }
         END { printf "%d packages, %.0f MB to fetch, %.0f MB on the disk\n", count, fetched / 1e6, installed / 1e6 }'
