#!/usr/bin/env bash
# Installs what is missing, then builds and tests everything. Fails on a failed and on a skipped test.
#
# Usage: ./test.sh                 the stages format, bench, bench-asan, bench-fuzz and visionbox-qemu
#        ./test.sh quick           while you work: format and bench-quick
#        ./test.sh long            what the default leaves out: bench-long and bench-tidy
#        ./test.sh STAGE...        some of them
#
#   format          clang-format finds nothing to change
#   bench           optimised build, warnings are errors, every header compiled alone, all tests and
#                   checks but those labelled `long`
#   bench-asan      the tests under the address and undefined-behaviour sanitizers, built by clang
#   bench-fuzz      in the folder of bench-asan: a short run of each fuzzer
#   visionbox-qemu  arm64 build, its tests run under emulation
#   bench-quick     in the folder of bench: the program, the tests that take less than a second, layering
#   bench-long      each source of a test compiled alone too, and the tests labelled `long`
#   bench-tidy      clang-tidy on all but the tests
#
# `./test.sh long` is to be run before a version is given away, after a change of the tracking, of the
# judging or of the campaign, and when a test or helper moves. CONTRIBUTING.md has what each stage costs.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")" || exit 1

stages=("$@")
[ ${#stages[@]} -gt 0 ] || stages=(format bench bench-asan bench-fuzz visionbox-qemu)
case ${stages[*]} in
  quick) stages=(format bench-quick) ;;
  long) stages=(bench-long bench-tidy) ;;
esac
for stage in "${stages[@]}"; do
  case $stage in
    format | bench | bench-asan | bench-fuzz | visionbox-qemu | bench-quick | bench-long | bench-tidy) ;;
    *)
      echo "$0: unknown stage '$stage'; sed -n 2,19p $0 lists them" >&2
      exit 2
      ;;
  esac
done

scripts/install_packages.sh bench test || exit 1

# Puts into `spent` the seconds of processor time of all that was started so far: unlike the clock they
# say the same on a busy machine.
processor_time() {
  times > "$times_file"
  spent=$(awk 'NR == 2 { split($1, user, /[ms]/); split($2, sys, /[ms]/)
    print int(60 * (user[1] + sys[1]) + user[2] + sys[2]) }' "$times_file")
}
times_file=$(mktemp)
trap 'rm -f "$times_file"' EXIT

failed=()
results=()
for stage in "${stages[@]}"; do
  echo "=== $stage"
  SECONDS=0
  processor_time
  before=$spent
  case $stage in
    format)
      scripts/format.sh --check || {
        echo "scripts/format.sh puts this right"
        failed+=("$stage")
      }
      ;;
    *)
      result=build/$stage/ctest.xml
      case $stage in
        bench-quick) result=build/bench/ctest-quick.xml ;;
        bench-fuzz) result=build/bench-asan/ctest-fuzz.xml ;;
      esac
      if [ "$stage" != bench-tidy ]; then
        rm -f "$result"
        results+=("$result")
      fi
      if [ "$stage" = visionbox-qemu ] && ! toolchain/arm64_sysroot.sh build/sysroot-arm64; then
        failed+=("$stage")
        continue
      fi
      if [ "$stage" = bench ] && ! toolchain/gpiod2.sh build/gpiod2; then
        echo "=== libgpiod 2.x is not tested: its header could not be fetched"
      fi
      cmake --workflow --preset "$stage" || failed+=("$stage")
      ;;
  esac
  processor_time
  echo "=== $stage took $SECONDS s, $((spent - before)) s of processor time"
done

echo "=== summary"
[ ${#failed[@]} -eq 0 ] || echo "failed stages: ${failed[*]}"
if [ ${#results[@]} -gt 0 ]; then
  python3 scripts/ctest_summary.py --slow tests/slow_tests.txt "${results[@]}" || failed+=(summary)
fi
[ ${#failed[@]} -eq 0 ]
