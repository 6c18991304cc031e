#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# installed.sh BUILD CONSUMER WORK: installs BUILD below WORK and uses what was installed.
set -eu
build=$1 consumer=$2 work=$3
rm -rf -- "$work"
cmake --install "$build" --prefix "$work/prefix" >"$work.log"

# The CMake package.
cmake -S "$consumer" -B "$work/cmake" -DCMAKE_PREFIX_PATH="$work/prefix" >>"$work.log"
cmake --build "$work/cmake" >>"$work.log"
from_cmake=$("$work/cmake/consumer")

# pkg-config, with the prefix moved elsewhere.
mv "$work/prefix" "$work/moved"
pc=$(find "$work/moved" -name bicycle.pc)
export PKG_CONFIG_PATH="${pc%/*}"
# shellcheck disable=SC2046 # a list of flags
cc -std=c17 "$consumer/main.c" $(pkg-config --cflags --libs bicycle) -o "$work/with_pkg_config"
from_pkg_config=$(LD_LIBRARY_PATH=$(pkg-config --variable=libdir bicycle) "$work/with_pkg_config")

# The installed program finds its library and the shipped bicycles wherever it lies.
from_program=$(cd / && "$work/moved/bin/bicycle" stability benchmark --json |
  sed -n 's/.*"weave_speed": \([0-9.]*\).*/\1/p')

# The program beside it, its neighbour and its examples.
(cd -- "$work" && moved/bin/bicycle sweep moved/share/bicycle/sweep/trail_and_speed.yml -o installed &&
  [ "$(wc -l <installed.csv)" -eq 1381 ])

echo "weave speed: $from_cmake $from_pkg_config $from_program"
[ "$from_cmake" = "$from_pkg_config" ]
[ "$from_cmake" = "$from_program" ]
case $from_cmake in 4.29238253634*) ;; *) exit 1 ;; esac
