#!/usr/bin/env bash
# Builds the images osteomill-server and osteomill-client of the project's Debian packages.
#   docker/build_images.sh [--base IMAGE] [--packages FOLDER]
# FOLDER is as scripts/package.sh leaves it: out/packages/SUITE of the newest suite unless said otherwise. IMAGE is the Debian that they
# are for: debian:SUITE-slim unless said otherwise, or what make_base_image.sh made. DOCKER=podman builds them with Podman.
set -euo pipefail
cd "$(dirname "$0")/.."

. scripts/debian_suite.sh
packages=out/packages/${supported_suites[-1]}
base=
while [ $# -gt 0 ]; do
    case $1 in
        --base) base=${2:?"--base needs an image"}; shift 2 ;;
        --packages) packages=${2:?"--packages needs a folder"}; shift 2 ;;
        *) echo "unknown argument '$1'; choose from --base IMAGE, --packages FOLDER" >&2; exit 2 ;;
    esac
done
[ -e "$packages/commit" ] || { echo "$packages holds no packages: scripts/package.sh builds them, on the Debian that they are for" >&2; exit 1; }
base=${base:-debian:$(sed -n 's/^Distribution: //p' "$packages"/osteomill_*.changes)-slim}

context=$(mktemp -d)
trap 'rm -rf "$context"' EXIT
cp docker/*.sh "$packages"/osteomill-{server,tools,client}_*.deb "$context"
export BUILDAH_FORMAT=docker  # the own format of Podman has no health checks
# The host's network while libraries are installed: a dockerd that was started by hand may have no way out of its bridges.
for image in server client; do
    "${DOCKER:-docker}" build --network host --build-arg "BASE=$base" --label "org.opencontainers.image.revision=$(cat "$packages/commit")" \
        -t "osteomill-$image" -f "docker/$image.Dockerfile" "$context"
done
