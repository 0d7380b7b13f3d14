#!/usr/bin/env bash
# Installs what is missing, builds the program and replays the recording that comes with it.
#
# Usage: ./bench.sh           replays the recording
#        ./bench.sh --page    runs a simulated box and opens its page in a browser, until Ctrl-C
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

session=tests/data/recordings/two_visits/session.toml
recording=tests/data/recordings/two_visits/recording.y4m.xz
out=build/bench-run

case ${1:-} in
  "") target=tubesight ;;
  --page) target=tubesightd ;;
  *)
    echo "$0: '$1', expected nothing or --page" >&2
    exit 2
    ;;
esac

scripts/install_packages.sh bench

mkdir -p build "$out"

build() {
  cmake --preset bench -DTUBESIGHT_BUILD_TESTS=OFF \
    && NINJA_STATUS='[%p] ' cmake --build --preset bench --target "$target"
}

# Tells how far ninja is: in one line of a terminal, else every ten per cent.
tell_progress() {
  local line percent told=-10
  while IFS= read -r line; do
    [[ $line =~ ^\[\ *([0-9]+)%\] ]] || continue
    percent=${BASH_REMATCH[1]}
    if [ -t 1 ]; then
      printf '\rbuilding: %3d %%' "$percent"
    elif [ "$percent" -ge $((told + 10)) ]; then
      echo "building: $percent %"
      told=$((percent / 10 * 10))
    fi
  done
  if [ -t 1 ]; then
    echo
  fi
}

echo "building; the compiler's words go to build/bench.log"
if ! build 2>&1 | tee build/bench.log | tell_progress; then
  tail -n 30 build/bench.log >&2
  echo "$0: the build failed; all of it is in build/bench.log" >&2
  exit 1
fi

# Opens the page when it is served, where there is a browser and a screen for it.
open_page() {
  local link=http://127.0.0.1:8080/ tries
  for tries in $(seq 50); do
    if (exec 3<> /dev/tcp/127.0.0.1/8080) 2> /dev/null; then
      echo "the page: $link"
      if [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ] && command -v xdg-open > /dev/null; then
        xdg-open "$link" > /dev/null 2>&1 || true
      fi
      return
    fi
    sleep 0.2
  done
  echo "$0: the page is not served after $((tries / 5)) s" >&2
}

if [ "$target" = tubesightd ]; then
  open_page &
  exec build/bench/bin/tubesightd docs/examples/box-with-page.toml
fi

rm -rf "${out:?}"/*
build/bench/bin/tubesight replay "$session" "$recording" \
  --fields "$out/fields.csv" --centers "$out/centers.csv" --overlay "$out/overlay"

fields=$(($(wc -l < "$out/fields.csv") - 1))
centers=$(($(wc -l < "$out/centers.csv") - 1))
pictures=$(find "$out/overlay" -name '*.png' | wc -l)
echo
echo "$out/fields.csv: $fields fields; the first and the last of them:"
head -n 4 "$out/fields.csv"
echo "..."
tail -n 3 "$out/fields.csv"
echo "$out/centers.csv: $centers tube-ends measured"
echo "$out/overlay/: $pictures pictures, what the operator sees"
