#!/usr/bin/env bash
# Drills the caries out of the built-in jaw: the server with a simulated hand and arm, the client in a window if
# there is a display, else offscreen. Ends by itself; leaves everything in out/demo/, the other programs in build/release/bin and
# the Python module in build/release/python.
set -euo pipefail
cd "$(dirname "$0")"
source scripts/prepare.sh

install_packages scripts/packages.txt
say "compiling the two programs of the drilling: $(about_minutes 480), the first time"
build release haptic_server render_client

out=out/demo
rm -rf "$out"
mkdir -p "$out/frames"
bin=build/release/bin

say "drilling: forces at 1 kHz, the bone at 30 Hz"
# Port 0: the system picks a free one and the server says which.
"$bin/haptic_server" --case jaw --listen 127.0.0.1:0 --log-csv "$out/forces.csv" --save-bone "$out/carved.nrrd" \
    --json "$out/server.json" >"$out/server.log" 2>"$out/server.err" &
server=$!
trap 'kill "$server" 2>/dev/null || true' EXIT
port=
for _ in $(seq 1200); do
    port=$(sed -n 's/^listening on .*:\([0-9]*\)$/\1/p' "$out/server.log")
    [ -n "$port" ] && break
    kill -0 "$server" 2>/dev/null || { cat "$out/server.err" >&2; exit 1; }
    sleep 0.1
done
[ -n "$port" ] || { echo "the server did not start listening within two minutes" >&2; exit 1; }

# The server comes first: on a small machine drawing must not take its cores.
view=(--offscreen --frames 100000)
if [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ]; then view=(--until-server-ends); fi
nice -n 5 "$bin/render_client" --connect "127.0.0.1:$port" "${view[@]}" --screenshots "$out/frames" --screenshot-every 60 \
    --json "$out/client.json"
wait "$server"
trap - EXIT

scripts/plot_forces.py "$out/forces.csv" "$out/forces.png"
printf '{"server": %s,\n"client": %s}\n' "$(cat "$out/server.json")" "$(cat "$out/client.json")" >"$out/summary.json"
rm "$out/server.json" "$out/client.json"

say "compiling the other programs and the Python module: $(about_minutes 180), the first time"
build release packet_replay bone_import bone_export osteomill_slicer osteomill_study osteomill_python

say "done: look into $out/; the programs are in $bin/, the Python module in build/release/python"
ls "$out"
