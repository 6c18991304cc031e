#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Shows that the fuzz targets see: puts back faults of the past, faults/TARGET.patch, in a copy of the
# project, and demands that each target finds its own.
set -eu

usage() {
  cat <<'END'
Example: sh tests/fuzz/faults.sh
         sh tests/fuzz/faults.sh 120

Seconds: how long a target may look for its fault (60). Works in build/faults. Exit status: 0 all
faults are found; 1 one is not, or its patch does not fit any more; 2 the set-up failed.
END
}

test_packages=yes # read by setup.sh
root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
# shellcheck source=cmake/setup.sh
. "$root/cmake/setup.sh"

seconds=${1:-60}
copy=$root/build/faults
patches=$root/tests/fuzz/faults
mkdir -p "$copy"
for part in CMakeLists.txt CMakePresets.json cmake model plugin src tests validate; do
  rm -rf "${copy:?}/$part"
  cp -Rp "$root/$part" "$copy/$part"
done
cd -- "$copy"
for patch in "$patches"/*.patch; do
  patch -s -p1 -i "$patch" >&2 || { say "$patch does not fit"; exit 1; }
done
root=$copy
build fuzz

missed=0
for patch in "$patches"/*.patch; do
  name=$(basename -- "$patch" .patch)
  log=$copy/build/$name.log
  set --
  [ ! -f "tests/fuzz/dict/$name" ] || set -- "-dict=tests/fuzz/dict/$name"
  status=0
  start=$(date +%s)
  "build/fuzz/tests/fuzz_$name" -max_total_time="$seconds" -timeout=20 -rss_limit_mb=4096 \
    -max_len=6000 -artifact_prefix="$copy/build/$name-" -print_final_stats=1 "$@" \
    "tests/fuzz/corpus/$name" >"$log" 2>&1 || status=$?
  time=$(($(date +%s) - start))
  executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  if grep -q 'not so: ' "$log"; then
    printf '%-10s found in %3d s, %s executions: %s\n' "$name" "$time" "$executions" \
      "$(sed -n 's/.*not so: \(.\{1,60\}\).*/\1/p' "$log" | head -n 1)"
  else
    printf '%-10s NOT found in %3d s, %s executions (status %d)\n' "$name" "$time" "$executions" \
      "$status"
    missed=$((missed + 1))
  fi
done
printf '%d faults missed\n' "$missed"
[ "$missed" -eq 0 ] || exit 1
