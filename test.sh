#!/usr/bin/env bash
# Installs what is missing, then builds and tests everything. Fails on a failed and on a skipped test.
#
# Usage: ./test.sh                 the stages format, bench, bench-asan, visionbox-qemu and bench-fuzz
#        ./test.sh quick           while you work: format and bench-quick
#        ./test.sh long            what the default leaves out: bench-long, bench-tidy, board-long and packages
#        ./test.sh STAGE...        some of them
#
#   format          clang-format finds nothing to change
#   bench           optimised build, warnings are errors, all tests and checks but those labelled `long`
#   bench-asan      the tests under the address and undefined-behaviour sanitizers, built by clang
#   visionbox-qemu  arm64 build, its tests run under emulation, and those of the emulated board
#   bench-fuzz      in the folder of bench-asan: a short run of each fuzzer
#   bench-quick     the program and the tests that take less than a second, compiled in less time, layering
#   bench-long      each source and each header compiled alone, and the tests labelled `long`
#   bench-tidy      clang-tidy on all but the tests
#   board-long      in the folder of visionbox-qemu: the tests of the emulated board labelled `long`
#   packages        the boards' packages, each built twice in two folders from clean checkouts: identical
#
# `./test.sh long` is to be run before a version is given away, after a change of the tracking, of the
# judging or of the campaign, and when a test or helper moves. CONTRIBUTING.md has what each stage costs.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")" || exit 1

stages=("$@")
[ ${#stages[@]} -gt 0 ] || stages=(format bench bench-asan visionbox-qemu bench-fuzz)
case ${stages[*]} in
  quick) stages=(format bench-quick) ;;
  long) stages=(bench-long bench-tidy board-long packages) ;;
esac
for stage in "${stages[@]}"; do
  case $stage in
    format | bench | bench-asan | bench-fuzz | visionbox-qemu | bench-quick) ;;
    bench-long | bench-tidy | board-long | packages) ;;
    *)
      echo "$0: unknown stage '$stage'; sed -n 2,20p $0 lists them" >&2
      exit 2
      ;;
  esac
done

scripts/install_packages.sh bench test image || exit 1

work=$(mktemp -d)
ahead=  # the stage that is built in the background, and its process
trap '[ -z "$ahead" ] || kill -- "-$builder" 2> /dev/null; rm -rf "$work"' EXIT

# Puts into `spent` the seconds of processor time of all that this shell started and waited for: unlike
# the clock they say the same on a busy machine.
processor_time() {
  local file=$work/times.$BASHPID
  times > "$file"
  spent=$(awk 'NR == 2 { split($1, user, /[ms]/); split($2, sys, /[ms]/)
    print int(60 * (user[1] + sys[1]) + user[2] + sys[2]) }' "$file")
}

# measured NAME COMMAND... runs the command and tells what it took.
measured() {
  local name=$1 start=$SECONDS before status
  processor_time
  before=$spent
  "${@:2}"
  status=$?
  processor_time
  echo "=== $name took $((SECONDS - start)) s, $((spent - before)) s of processor time"
  return "$status"
}

# The configure preset of a stage, which is also the folder in build/.
folder_of() {
  case $1 in
    bench-fuzz) echo bench-asan ;;
    board-long) echo visionbox-qemu ;;
    *) echo "$1" ;;
  esac
}

build_stage() {
  case $1 in
    visionbox-qemu | board-long)
      toolchain/debian_sysroot.sh arm64 build/sysroot-arm64 || return 1
      python3 -B tests/system/board/board_parts.py || return 1
      ;;
    bench)
      toolchain/gpiod2.sh build/gpiod2 \
        || echo "=== libgpiod 2.x is not tested: its header could not be fetched"
      ;;
  esac
  cmake --preset "$(folder_of "$1")" && cmake --build --preset "$1"
}

check_stage() {
  case $1 in
    format) scripts/format.sh --check || { echo "scripts/format.sh puts this right"; return 1; } ;;
    bench-tidy) ;;
    packages) tests/checks/packages_twice.sh ;;
    *) ctest --preset "$1" ;;
  esac
}

# Builds a stage while another's tests run, which leave processors idle: in the background, in a process
# group of its own, so that the trap ends all of it, and only with what is left of the processors, as some
# of the tests keep time.
build_ahead() {
  ahead=$1
  : > "$work/$1.log"  # whoever follows it may come first
  set -m
  (
    if [ "$stage" != format ]; then
      renice -n 19 "$BASHPID"
      chrt --idle --pid 0 "$BASHPID"
    fi > "$work/priority" 2>&1
    measured "building $1" build_stage "$1"
  ) > "$work/$1.log" 2>&1 < /dev/null &
  builder=$!
  set +m
}

results=()
for stage in "${stages[@]}"; do
  result=build/$(folder_of "$stage")/ctest.xml
  case $stage in
    format | bench-tidy | packages) continue ;;
    bench-fuzz) result=build/bench-asan/ctest-fuzz.xml ;;
    board-long) result=build/visionbox-qemu/ctest-board-long.xml ;;
  esac
  rm -f "$result"
  results+=("$result")
done

failed=()
for index in "${!stages[@]}"; do
  stage=${stages[index]}
  next=${stages[index + 1]:-}
  echo "=== $stage"
  if [ "$stage" = format ] || [ "$stage" = packages ]; then
    built=0
  elif [ "$ahead" = "$stage" ]; then
    tail -n +1 -f -s 0.2 --pid="$builder" "$work/$stage.log"
    wait "$builder"
    built=$?
    ahead=
  else
    measured "building $stage" build_stage "$stage"
    built=$?
  fi
  case $next in
    '' | format | packages) ;;
    *) [ "$(folder_of "$next")" = "$(folder_of "$stage")" ] || build_ahead "$next" ;;
  esac
  # In a shell of its own, which does not count the processor time of what is built meanwhile.
  [ "$built" -eq 0 ] && (measured "testing $stage" check_stage "$stage") || failed+=("$stage")
done

echo "=== summary"
[ ${#failed[@]} -eq 0 ] || echo "failed stages: ${failed[*]}"
if [ ${#results[@]} -gt 0 ]; then
  python3 scripts/ctest_summary.py --slow tests/slow_tests.txt "${results[@]}" || failed+=(summary)
fi
[ ${#failed[@]} -eq 0 ]
