#!/usr/bin/env bash
# Builds the images osteomill-server and osteomill-client, and osteomill-programs, from which they take the programs.
#   docker/build_images.sh [--base IMAGE] [--programs FOLDER]
# IMAGE is a Debian 12: debian:bookworm-slim unless said otherwise, or what make_base_image.sh made. FOLDER holds programs that
# were built on a Debian 12, such as build/release/bin; without it they are compiled, once, in a stage of their own.
set -euo pipefail
cd "$(dirname "$0")/.."

base=debian:bookworm-slim
programs=
while [ $# -gt 0 ]; do
    case $1 in
        --base) base=${2:?"--base needs an image"}; shift 2 ;;
        --programs) programs=${2:?"--programs needs a folder"}; shift 2 ;;
        *) echo "unknown argument '$1'; choose from --base IMAGE, --programs FOLDER" >&2; exit 2 ;;
    esac
done

# The host's network while packages are installed: a dockerd that was started by hand may have no way out of its bridges.
build() { docker build --network host --build-arg "BASE=$base" -t "osteomill-$1" -f "docker/$2.Dockerfile" "$3"; }

if [ -n "$programs" ]; then
    context=$(mktemp -d)
    trap 'rm -rf "$context"' EXIT
    cp "$programs"/{haptic_server,packet_replay,render_client} "$context"
    build programs prebuilt "$context"
else
    build programs programs .
fi
build server server docker
build client client docker
