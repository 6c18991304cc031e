#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Builds everything twice, optimised and with sanitizers and assertions, and runs all tests in both.
set -eu

usage() {
  cat <<'END'
Example: sh tests/run.sh
         sh tests/run.sh -R cli

Installs missing Debian packages (as root, or with sudo), builds into build/asan and build/release,
and runs all tests of both.

  --print-packages  only list the Debian packages needed
  --no-install      install nothing
  --help            this text

Other arguments go to ctest. Exit status: 0 all tests pass; 2 wrong usage, or the set-up failed;
else that of ctest.
END
}

test_packages=yes # read by setup.sh
root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
# shellcheck source=cmake/setup.sh
. "$root/cmake/setup.sh"

cd -- "$root"
# What was just installed is there: a test that skips itself for want of it would hide a fault.
[ "$install" = no ] || export BICYCLE_REQUIRE_BROWSER=1
# The first preset that fails ends the run, so that the last lines are the summary that decided.
for preset in asan release; do
  build "$preset"
  say "Tests of build/$preset:"
  ctest --preset "$preset" "$@"
done
