#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Whether sympy_equations.h is what derive.py writes.
#
# Example: derived.sh hash PEERS          the script is the one that wrote the file
#          derived.sh again PEERS BUILD   derives once more, in BUILD, and compares
#
# Exit status: 0 it is; 1 it is not; 77 there is no sympy, or another version than that of the file.
set -eu

peers=$2
written=$peers/sympy_equations.h
case $1 in
hash)
  set -- "$(sha256sum "$peers/derive.py")"
  hash=${1%% *}
  if ! grep -q "sha256 of derive.py: $hash\$" "$written"; then
    echo "derive.py has changed: python3 derive.py -o sympy_equations.h in $peers" >&2
    exit 1
  fi
  ;;
again)
  python=${BICYCLE_BENCH_PYTHON:-/usr/bin/python3}
  version=$("$python" -I -c 'import sympy; print(sympy.__version__)' 2>/dev/null) || exit 77
  grep -q "sympy $version;" "$written" || exit 77
  "$python" -I "$peers/derive.py" -o "$3/sympy_equations.h"
  cmp "$3/sympy_equations.h" "$written"
  ;;
*)
  echo "derived.sh: hash or again, not $1" >&2
  exit 2
  ;;
esac
