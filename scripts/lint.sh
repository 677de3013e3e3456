#!/usr/bin/env bash
# Looks for faults in the product's code with clang-tidy (.clang-tidy) and for code that clang-format would write otherwise.
#   scripts/lint.sh             all of the product
#   scripts/lint.sh FILE...     these sources
# It needs clang-tidy and clang-format (Debian 12: 14) and configures the preset `debug`, in which every source is by itself.
set -euo pipefail
cd "$(dirname "$0")/.."

sources=("$@")
[ ${#sources[@]} -gt 0 ] || mapfile -t sources < <(git ls-files 'common/*.cpp' 'simulation/*.cpp' 'devices/*.cpp' 'imaging/*.cpp' \
    'analysis/*.cpp' 'haptic_server/*.cpp' 'render_client/*.cpp' 'python/*.cpp' 'studies/*.cpp')

cmake --preset debug >/dev/null
cmake --build --preset debug --target osteomill_proto >/dev/null
printf '%s\0' "${sources[@]}" | xargs -0 clang-format --dry-run --Werror
printf '%s\0' "${sources[@]}" | xargs -0 -n 1 -P "$(nproc)" clang-tidy -p build/debug --quiet --extra-arg=-Wno-unknown-warning-option
