#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Counts the arithmetic of the scalar kernel in its machine code: additions, subtractions, products,
# quotients and square roots of doubles, one each, and fused multiply-adds, one each.
#
# Example: count.sh objdump plain.o fused.o kernel_count.h
#
# plain.o holds no fused ones, fused.o as many as the compiler finds. On machines whose instructions
# are not known here, and where the code is not one straight line, the counts are 0: unknown.
set -eu

count() {
  "$1" -dr --no-show-raw-insn --disassemble=bench_counted_kernel "$2" | awk -F '\t' '
    /R_X86_64_P.*sincos/ { sincos++ }
    !/^ +[0-9a-f]+:\t/ { next }
    { split($2, word, " "); name = word[1] }
    name ~ /^v?(add|sub|mul|div|sqrt)sd$/ || name ~ /^vfn?m(add|sub)(132|213|231)sd$/ { sum++ }
    name ~ /^v?(add|sub|mul|div|sqrt)pd$/ || name ~ /^vfn?m[a-z]*(132|213|231)pd$/ { unknown = 1 }
    name ~ /^j/ || name ~ /^loop/ { unknown = 1 }
    END { if (unknown || !sum) print 0, 0; else print sum, sincos + 0 }'
}

plain=$(count "$1" "$2")
fused=$(count "$1" "$3")
cat >"$4.part" <<END
// Made by count.sh while building.
#define BENCH_KERNEL_OPERATIONS ${plain% *}
#define BENCH_KERNEL_INSTRUCTIONS ${fused% *}
#define BENCH_KERNEL_SINCOS ${plain#* }
END
mv "$4.part" "$4"
