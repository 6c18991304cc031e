#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# shipped_drawings.sh BICYCLE MODELS WORK: the pictures beside the shipped bicycles are those that
# `bicycle draw` makes of them today.
set -eu
bicycle=$1 models=$2 work=$3
mkdir -p -- "$work"
count=0
for file in "$models"/*/*.yml; do
  name=$(basename -- "$file" .yml)
  "$bicycle" draw "$file" -o "$work/$name.svg"
  cmp -- "$work/$name.svg" "$models/$name/$name.svg" ||
    { echo "renew it: bicycle draw $name -o model/$name/$name.svg"; exit 1; }
  count=$((count + 1))
done
echo "$count drawings"
[ "$count" -ge 6 ]
