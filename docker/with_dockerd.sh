#!/usr/bin/env bash
# Runs a command with a Docker of its own, for a machine whose own is not running: as root, in a container or a virtual machine
# without systemd.
#   docker/with_dockerd.sh COMMAND [ARGUMENT...]
# Images stay in OSTEOMILL_DOCKER_ROOT (/var/tmp/osteomill-docker), which must not lie within a build context. Firewall rules and
# forwarding are left alone: containers reach one another, and nothing else.
set -euo pipefail
[ $# -gt 0 ] || { echo "usage: docker/with_dockerd.sh COMMAND [ARGUMENT...]" >&2; exit 2; }
[ "$(id -u)" -eq 0 ] || { echo "dockerd needs root" >&2; exit 1; }
command -v dockerd >/dev/null || { echo "dockerd is not installed (apt-get install docker.io)" >&2; exit 1; }

root=${OSTEOMILL_DOCKER_ROOT:-/var/tmp/osteomill-docker}
mkdir -p "$root"
export DOCKER_HOST=unix://$root/socket
log=$root/dockerd.log

# The default driver is overlay2; where the root lies on an overlay itself, only vfs works, which copies every layer.
for driver in overlay2 vfs; do
    dockerd --data-root "$root/data" --exec-root "$root/exec" --pidfile "$root/pid" -H "$DOCKER_HOST" \
        --storage-driver "$driver" --iptables=false --ip-forward=false >"$log" 2>&1 &
    dockerd=$!
    trap 'kill "$dockerd" 2>/dev/null; wait "$dockerd" 2>/dev/null || true' EXIT
    for _ in $(seq 60); do
        docker info >/dev/null 2>&1 && break 2
        kill -0 "$dockerd" 2>/dev/null || break
        sleep 0.5
    done
done
docker info >/dev/null 2>&1 || { echo "dockerd does not start: $(tail -1 "$log")" >&2; exit 1; }
"$@"
