#!/usr/bin/env bash
# Installs, builds and runs the tests: optimised, then under AddressSanitizer and UBSan; those of code with threads under
# ThreadSanitizer, too. With AddressSanitizer, a minute of hostile input under libFuzzer.
#   ./test.sh             as continuous integration: all of these, without the tests of the label `nightly`
#   ./test.sh all         those, too, more programs under the sanitizers and longer fuzzing; the benchmarks are built, and demo, tests and
#                         packages are tried in a bare root of the other Debian, where one can be made
#   ./test.sh release     one (or several) of: release debug asan tsan; `all` before them as above
set -euo pipefail
cd "$(dirname "$0")"
source scripts/prepare.sh

left_out=(-LE nightly)
everything=
more=()
configure=()
fuzzing_s=6  # each of the eleven targets
if [ "${1:-}" = all ]; then
    left_out=()
    more=(all benchmarks)
    configure=(-DOSTEOMILL_NIGHTLY=ON)
    fuzzing_s=60
    everything=yes
    shift
fi
presets=("$@")
[ ${#presets[@]} -gt 0 ] || presets=(release asan tsan)
for preset in "${presets[@]}"; do
    case $preset in
        release | debug | asan | tsan) ;;
        *) echo "unknown preset '$preset'; choose from release debug asan tsan" >&2; exit 2 ;;
    esac
done

install_packages scripts/packages.txt scripts/test_packages.txt
# For the tests in a virtual machine, which are skipped without it.
scripts/fetch_vm_kernel.sh || echo "the tests in a virtual machine will be skipped" >&2
for preset in "${presets[@]}"; do
    case $preset in
        release | debug) build "$preset" "${more[@]}" ;;
        *) build "$preset" ;;
    esac
    say "testing: $preset"
    # Many tests wait more than they compute: twice as many as there are cores.
    ctest --preset "$preset" "${left_out[@]}" -j "$(($(nproc) * 2))"
    if [ "$preset" = asan ]; then
        tests/fuzz/run.sh "$fuzzing_s"
    fi
done
if [ -n "$everything" ]; then try_other_debian demo test packages; fi
