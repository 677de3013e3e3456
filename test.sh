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
TIMEFORMAT="%0lR, %0U s of a core by programs and %0S s by the system"
# build_for_tests PRESET
build_for_tests() {
    case $1 in
        release | debug) time build "$1" "${more[@]}" ;;
        *) time build "$1" ;;
    esac
}

# While the tests of one preset run, which wait more than they compute, the next one is built at the lowest priority.
ahead=
ahead_log=$(mktemp)
trap '[ -z "$ahead" ] || kill -- "-$ahead" 2>/dev/null; rm -f "$ahead_log"' EXIT
build_ahead() {
    set -m  # a process group of its own, so that it can be ended
    (renice -n 19 "$BASHPID" >/dev/null && build_for_tests "$1") >"$ahead_log" 2>&1 &
    set +m
    ahead=$!
}
see_what_was_built_ahead() {
    tail -n +1 -f --pid "$ahead" "$ahead_log"
    local built=$ahead
    ahead=
    wait "$built"
}

for i in "${!presets[@]}"; do
    preset=${presets[i]}
    next=${presets[i + 1]:-}
    if [ -n "$ahead" ]; then see_what_was_built_ahead; else build_for_tests "$preset"; fi
    [ -z "$next" ] || build_ahead "$next"
    say "testing: $preset"
    # Twice as many tests as there are cores.
    time ctest --preset "$preset" "${left_out[@]}" -j "$(($(nproc) * 2))"
    if [ "$preset" = asan ]; then
        tests/fuzz/run.sh "$fuzzing_s"
    fi
done
if [ -n "$everything" ]; then try_other_debian demo test packages; fi
