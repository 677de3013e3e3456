#!/usr/bin/env bash
# Makes the image osteomill-base:SUITE, a bare Debian, with debootstrap: for a machine that cannot pull one. As root.
#   docker/make_base_image.sh [SUITE [MIRROR]]      SUITE: trixie unless said otherwise
# The mirror stays in the image, for what is installed on top.
set -euo pipefail
suite=${1:-trixie}
mirror=${2:-http://deb.debian.org/debian}
for program in debootstrap docker; do
    command -v "$program" >/dev/null || { echo "$program is not installed (apt-get install debootstrap docker.io)" >&2; exit 1; }
done
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
debootstrap --variant=minbase "$suite" "$root" "$mirror" >"$root.log" 2>&1 || { tail "$root.log" >&2; exit 1; }
rm -rf "$root.log" "$root"/var/cache/apt/archives/*.deb
tar -C "$root" -c . | docker import - "osteomill-base:$suite"
