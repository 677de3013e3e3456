#!/usr/bin/env bash
# Fuzzes with the targets built by the preset `asan`, as many at once as there are cores.
#   tests/fuzz/run.sh SECONDS [TARGET...]     all of them, or some: frame_decoder server_session client_session recording scene
#                                             haply_state nrrd_header meta_image_header nifti_header dicom_header
#                                             dicom_segmentation
# SECONDS are for each target. Findings lie in build/asan/fuzz/findings; give one to build/asan/bin/fuzz_TARGET to see it again,
# and put it into tests/fuzz/seeds/TARGET once it is fixed.
set -euo pipefail
cd "$(dirname "$0")/../.."

seconds=${1:?"usage: tests/fuzz/run.sh SECONDS [TARGET...]"}
shift
targets=("$@")
[ ${#targets[@]} -gt 0 ] || targets=(client_session recording server_session scene frame_decoder haply_state
    dicom_header nrrd_header meta_image_header nifti_header dicom_segmentation)
mkdir -p build/asan/fuzz/findings

# Memory: a gigabyte, although the largest input makes tens of megabytes. One allocation may be as large as the largest bone
# that a snapshot may announce, which costs addresses. A hang: ten seconds, although an input takes milliseconds.
fuzz_one() {
    local target=$1 seconds=$2 corpus=build/asan/fuzz/corpus/$1 log=build/asan/fuzz/findings/$1.log
    local longest options=()
    case $target in
        recording) longest=16384 ;;
        *) longest=4096 ;;
    esac
    mkdir -p "$corpus"
    [ -f "tests/fuzz/dictionaries/$target.dict" ] && options+=(-dict="tests/fuzz/dictionaries/$target.dict")
    local seeds=("tests/fuzz/seeds/$target")
    [ "$target" = scene ] && seeds+=(scenes)
    if ! "build/asan/bin/fuzz_$target" "$corpus" "${seeds[@]}" -max_total_time="$seconds" -max_len="$longest" \
        -timeout=10 -rss_limit_mb=1024 -malloc_limit_mb=4200 -artifact_prefix="build/asan/fuzz/findings/$target-" \
        -print_final_stats=1 "${options[@]}" >"$log" 2>&1; then
        echo "$target: a finding"
        grep -v '^#' "$log" | tail -60
        return 1
    fi
    echo "$target: $(sed -n 's/^stat::number_of_executed_units: *//p' "$log") inputs in $seconds s without a finding," \
        "$(grep -c . <(ls "$corpus")) kept"
}
export -f fuzz_one
printf '%s\n' "${targets[@]}" | xargs -P "$(nproc)" -I{} bash -c 'fuzz_one "$1" "$2"' _ {} "$seconds"
