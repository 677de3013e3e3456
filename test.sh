#!/usr/bin/env bash
# Installs, builds and runs every test: optimised, then under AddressSanitizer and UBSan; those of code with threads under
# ThreadSanitizer, too. Last, a minute of hostile input under libFuzzer.
#   ./test.sh             all of these
#   ./test.sh release     one (or several) of: release debug asan tsan fuzz
set -euo pipefail
cd "$(dirname "$0")"
source scripts/prepare.sh

presets=("$@")
[ ${#presets[@]} -gt 0 ] || presets=(release asan tsan fuzz)
for preset in "${presets[@]}"; do
    case $preset in
        release | debug | asan | tsan | fuzz) ;;
        *) echo "unknown preset '$preset'; choose from release debug asan tsan fuzz" >&2; exit 2 ;;
    esac
done

install_packages scripts/packages.txt scripts/test_packages.txt
# For the tests in a virtual machine, which are skipped without it.
scripts/fetch_vm_kernel.sh || echo "the tests in a virtual machine will be skipped" >&2
for preset in "${presets[@]}"; do
    build "$preset"
    say "testing: $preset"
    if [ "$preset" = fuzz ]; then
        tests/fuzz/run.sh 12  # seconds for each of the eleven targets: a minute on two cores
    else
        # Many tests wait more than they compute: twice as many as there are cores.
        ctest --preset "$preset" -j "$(($(nproc) * 2))"
    fi
done
