#!/usr/bin/env bash
# Installs what is missing, builds the program and replays the recording that comes with it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

session=tests/data/recordings/square_flush/session.toml
recording=tests/data/recordings/square_flush/recording.y4m.xz
out=build/bench-run

scripts/install_packages.sh bench

mkdir -p build "$out"
if ! { cmake --preset bench -DTUBESIGHT_BUILD_TESTS=OFF \
  && cmake --build --preset bench --target tubesight; } > build/bench.log 2>&1; then
  tail -n 30 build/bench.log >&2
  echo "$0: the build failed; all of it is in build/bench.log" >&2
  exit 1
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
