#!/usr/bin/env bash
# Installs what is missing, then builds and tests everything. Fails on a failed and on a skipped test.
#
# Usage: ./test.sh                 all stages below but bench-tidy
#        ./test.sh STAGE...        some of them
#
#   format          clang-format finds nothing to change
#   bench           optimised build, warnings are errors, every header compiled alone, all tests and checks
#   bench-asan      the tests under the address, undefined-behaviour and float-cast sanitizers
#   bench-fuzz      a short run of each fuzzer
#   visionbox-qemu  arm64 build, its tests run under emulation
#   bench-tidy      clang-tidy on all but the tests (takes long, not part of the default)
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")" || exit 1

stages=("$@")
[ ${#stages[@]} -gt 0 ] || stages=(format bench bench-asan bench-fuzz visionbox-qemu)
for stage in "${stages[@]}"; do
  case $stage in
    format | bench | bench-asan | bench-fuzz | visionbox-qemu | bench-tidy) ;;
    *)
      echo "$0: unknown stage '$stage'; sed -n 2,14p $0 lists them" >&2
      exit 2
      ;;
  esac
done

scripts/install_packages.sh bench test || exit 1

failed=()
results=()
for stage in "${stages[@]}"; do
  echo "=== $stage"
  SECONDS=0
  case $stage in
    format)
      scripts/format.sh --check || {
        echo "scripts/format.sh puts this right"
        failed+=("$stage")
      }
      ;;
    *)
      if [ "$stage" != bench-tidy ]; then
        rm -f "build/$stage/ctest.xml"
        results+=("build/$stage/ctest.xml")
      fi
      if [ "$stage" = visionbox-qemu ] && ! toolchain/arm64_sysroot.sh build/sysroot-arm64; then
        failed+=("$stage")
        continue
      fi
      cmake --workflow --preset "$stage" || failed+=("$stage")
      ;;
  esac
  echo "=== $stage took $SECONDS s"
done

echo "=== summary"
[ ${#failed[@]} -eq 0 ] || echo "failed stages: ${failed[*]}"
if [ ${#results[@]} -gt 0 ]; then
  python3 scripts/ctest_summary.py "${results[@]}" || failed+=(summary)
fi
[ ${#failed[@]} -eq 0 ]
