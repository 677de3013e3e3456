#!/usr/bin/env bash
# A long session of the real programs with clients that come and go: memory, equal bones, a whole recording.
#   scripts/soak.sh [MINUTES [SEED]]     240 minutes unless said otherwise
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/prepare.sh

install_packages scripts/packages.txt scripts/test_packages.txt
build release soak haptic_server packet_replay
build/release/bin/soak build/release/bin/haptic_server build/release/bin/packet_replay "${1:-240}" "${2:-1}"
