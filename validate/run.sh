#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Compares the two simulators on the shipped scenarios, from nothing but a Debian machine.
set -eu

usage() {
  cat <<'END'
Example: sh validate/run.sh
         sh validate/run.sh -o /tmp/report

Installs missing Debian packages (as root, or with sudo), builds into build/release, and runs
`bicycle validate` on the shipped scenarios.

  --print-packages  only list the Debian packages needed
  --no-install      install nothing
  --help            this text

Other arguments go to `bicycle validate`. Exit status: 0 the simulators agree; 1 they do not;
2 wrong usage, or the set-up failed; 3 a run is invalid; 4 a baseline is missing.
END
}

root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd)
# shellcheck source=cmake/setup.sh
. "$root/cmake/setup.sh"

build release
exec "$root/build/release/bin/bicycle" validate "$@"
