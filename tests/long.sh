#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Checks that take too long for every change.
set -eu

# One check a line: NAME|SUBJECT|COMMAND. The command runs in the project's folder, with build/release
# built if it names that, prints its counts in its last line (beside ctest's total time), and returns 0
# if all is well.
checks() {
  cat <<'END'
mode_names|names of modes: 200 lists of speeds, 200 random bicycles|build/release/tests/test_modes 200 200
finite|finite or an error: a million bicycles of any magnitude|build/release/tests/test_finite 1000000
threads|thread sanitizer: ensembles, rolling contacts, suites of scenarios|cmake --preset tsan && cmake --build --preset tsan && ctest --preset tsan
analyse|static analysis: gcc's analyser over plugin|sh tests/analyse.sh --no-install gcc plugin/
fuzz|each fuzz target for two minutes|sh tests/fuzz.sh --no-install 120
faults|faults of the past, put back, are found by fuzzing|sh tests/fuzz/faults.sh --no-install
memory|allocations that fail, one at a time, 300 call stacks of every command|build/release/tests/faults_memory -v 1 -m 300
kills|kill -9 at random moments of ride, figures, mjcf, validate and sweep|build/release/tests/faults_kills 1000
END
}

usage() {
  cat <<'END'
Example: sh tests/long.sh
         sh tests/long.sh threads

Builds what they need and runs the checks that take longer than tests/run.sh may: all of them, or
those named. Logs go to build/long/NAME.log.

  --list            only list the checks
  --print-packages  only list the Debian packages needed
  --no-install      install nothing
  --help            this text

Exit status: 0 all checks pass; 1 one fails; 2 wrong usage, or the set-up failed.
END
}

test_packages=yes # read by setup.sh
root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
# shellcheck source=cmake/setup.sh
. "$root/cmake/setup.sh"

# The last line of a log that says something; ctest's total time does not.
last_line() {
  sed -n '/^Total Test time/!{/[^[:space:]]/h;}; ${x;p;}' "$1"
}

# run_check NAME SUBJECT COMMAND
run_check() {
  say "$1: $2 ..."
  start=$(date +%s)
  verdict=pass
  sh -c "$3" </dev/null >"$logs/$1.log" 2>&1 || verdict=FAIL
  seconds=$(($(date +%s) - start))
  printf '%s  %-12s %6d s  %s\n' "$verdict" "$1" "$seconds" "$(last_line "$logs/$1.log")"
  if [ "$verdict" = FAIL ]; then
    failed=$((failed + 1))
    tail -n 40 "$logs/$1.log" >&2
    say "$1 failed; its log is $logs/$1.log"
  fi
}

wanted() {
  [ -z "$chosen" ] || case " $chosen " in *" $1 "*) ;; *) return 1 ;; esac
}

for argument; do
  case $argument in
  --list) checks | sed 's/|\([^|]*\)|.*/: \1/' && exit 0 ;;
  -*) die "unknown option $argument (see --help)" ;;
  *) checks | grep -q "^$argument|" || die "no check '$argument' (see --list)" ;;
  esac
done
chosen=$*
cd -- "$root"
logs=$root/build/long
mkdir -p "$logs"
failed=0
count=0
list=$logs/checks
checks | while IFS= read -r check; do
  ! wanted "${check%%|*}" || printf '%s\n' "$check"
done >"$list"
! grep -q 'build/release/' "$list" || build release
while IFS='|' read -r name subject command; do
  count=$((count + 1))
  run_check "$name" "$subject" "$command"
done <"$list"
printf '%d checks, %d failed\n' "$count" "$failed"
[ "$failed" -eq 0 ] || exit 1
