#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# scaling.sh BIN [ROUNDS]: how much sooner a sweep is done on two processors, with threads, shards
# and ranks; medians of interleaved rounds. Not a test. The figures of src/sweep/README.md.
set -eu
bin=$1 rounds=${2:-5}
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"
PATH=$bin:$PATH
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
# 9600 rides of 1 to 60 s: starts that come back, circle and fall.
cat >rides.yml <<'END'
bicycle: roadster
sweep:
  speed: {from: 5, to: 6.5, count: 20}
  lean: {from: -0.5, to: 0.5, count: 24}
  steer: {from: -0.4, to: 0.4, count: 20}
outputs: [weave_speed, outcome, time]
END

seconds() { # COMMAND: wall clock from start to table, processor time of all its processes
  begun=$(date +%s.%N)
  used=$(sh -c "{ $1; } >/dev/null 2>&1; times" | tail -n 1)
  echo "$begun $(date +%s.%N) $used" | sed 's/[ms]/ /g' |
    awk '{print $2 - $1, 60 * $3 + $4 + 60 * $5 + $6}'
}

sweep='bicycle sweep rides.yml --fresh'
# shellcheck disable=SC2016 # expanded by the shell that runs it
shards='for k in 1 2; do '$sweep' -o s --threads 1 --shard $k/2 & done; wait
  bicycle sweep merge s.*of2.log -o s.csv'
for _ in $(seq "$rounds"); do
  seconds "$sweep -o a --threads 1" >>one_thread
  seconds "$sweep -o b --threads 2" >>two_threads
  seconds "$shards" >>two_shards
  seconds "mpirun --oversubscribe -n 2 $sweep -o c" >>one_worker
  seconds "mpirun --oversubscribe -n 3 $sweep -o d" >>two_workers
done
for name in b s c d; do cmp a.csv "$name.csv"; done

best() {
  sort -n "$1" | sed -n '1s/ .*//p'
}
median_used() {
  sort -n -k 2 "$1" | sed -n "$(((rounds + 1) / 2))s/.* //p"
}
echo "              wall s  times as fast  processor s"
for name in one_thread two_threads two_shards one_worker two_workers; do
  echo "$name $(best $name) $(best one_thread) $(median_used $name)" |
    awk '{printf "%-12s %7.2f %14.2f %12.2f\n", $1, $2, $3 / $2, $4}'
done
