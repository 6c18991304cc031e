#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Fuzzes the doors of the project with clang's libFuzzer and the sanitizers.
set -eu

usage() {
  cat <<'END'
Example: sh tests/fuzz.sh 60
         sh tests/fuzz.sh 600 scenario csv
         sh tests/fuzz.sh 60 --keep report

Builds build/fuzz and runs each target (tests/fuzz/fuzz_NAME.c), or those named, for so many seconds
from the corpus that is kept. What is found on the way stays in build/fuzz/corpus; an input that
fails, in build/fuzz/found.

  --keep            afterwards the kept corpus, tests/fuzz/corpus, is made anew: the smallest inputs
                    that together reach what is reached now
  --no-install      install nothing
  --print-packages  only list the Debian packages needed
  --help            this text

Exit status: 0 nothing found; 1 an input fails; 2 wrong usage, or the set-up failed.
END
}

test_packages=yes # read by setup.sh
root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
# shellcheck source=cmake/setup.sh
. "$root/cmake/setup.sh"

here=$root/tests/fuzz
keep=no
seconds=
targets=
for argument; do
  case $argument in
  --keep) keep=yes ;;
  *[!0-9]* | '')
    [ -f "$here/fuzz_$argument.c" ] || die "no target '$argument' in tests/fuzz (see --help)"
    targets="$targets $argument"
    ;;
  *) seconds=$argument ;;
  esac
done
[ -n "$seconds" ] || die "how many seconds? (see --help)"
[ -n "$targets" ] || targets=$(cd -- "$here" && ls fuzz_*.c | sed 's/fuzz_\(.*\)\.c/\1/')

cd -- "$root"
build fuzz
work=$root/build/fuzz
mkdir -p "$work/found"

# The options of every run. Memory: what the largest legal input takes, and far from the machine's.
fuzzer() {
  "$work/tests/fuzz_$name" -rss_limit_mb=4096 -timeout=20 -max_len=6000 \
    -artifact_prefix="$work/found/$name-" "$@"
}

# run_target: fuzzes for $seconds; a line with executions, edges and inputs.
run_target() {
  mkdir -p "$work/corpus/$name"
  log=$work/found/$name.log
  status=0
  set --
  [ ! -f "$here/dict/$name" ] || set -- "-dict=$here/dict/$name"
  fuzzer -max_total_time="$seconds" -print_final_stats=1 "$@" \
    "$work/corpus/$name" "$here/corpus/$name" >"$log" 2>&1 || status=$?
  executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  edges=$(sed -n 's/.* cov: \([0-9]*\) .*/\1/p' "$log" | tail -n 1)
  total=$((total + ${executions:-0}))
  printf '%-11s %9s executions  %6s edges  %s\n' "$name" "${executions:-0}" "${edges:-0}" \
    "$([ "$status" -eq 0 ] && echo 'nothing found' || echo "FOUND, see $log")"
  [ "$status" -eq 0 ] || found=$((found + 1))
}

keep_corpus() {
  kept=$work/kept/$name
  rm -rf "$kept"
  mkdir -p "$kept"
  fuzzer -merge=1 -use_counters=0 "$kept" "$here/corpus/$name" "$work/corpus/$name" >"$work/found/$name.merge" 2>&1 ||
    die "the corpus of $name cannot be merged; see $work/found/$name.merge"
  rm -f "$here/corpus/$name"/*
  cp "$kept"/* "$here/corpus/$name/"
  say "$name: $(ls "$kept" | wc -l) inputs kept"
}

found=0
total=0
count=0
for name in $targets; do
  count=$((count + 1))
  run_target
  [ "$keep" = no ] || keep_corpus
done
printf '%d targets, %d executions, %d with findings\n' "$count" "$total" "$found"
[ "$found" -eq 0 ] || exit 1
