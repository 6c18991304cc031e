// SPDX-License-Identifier: Apache-2.0
// Traces made small enough to stand in report.html; web/decode.js reads them back.
//
// One JSON object: {rows, step (s), stride, geometry, columns: [{name, unit, side, coding, low,
// scale, ends}], bytes}. `bytes` is base64 of zlib of the columns one after the other:
//   linear   24-bit steps between the smallest (`low`) and the largest value, as second
//   differences,
//            zigzag coded, three planes of bytes, low bytes first; the code 2^24 - 1 is no number
//   log      sign and size to 0.26 % in 16 bits, two planes: 0 is exactly zero, 32767 no number
// `side` is "signal" (the reference's, and from the first of its `ends` on the candidate's, which
// is known up to the second), "residual" (candidate - reference, computed in double) or an engine's
// label (energy balance, slip, height).
#ifndef VALIDATE_REPORT_PACK_H
#define VALIDATE_REPORT_PACK_H

#include "report.h"

// Every how many rows are kept so that all scenarios together stay within the page's budget.
size_t report_pack_stride(const report *r);

// Writes a scenario's object. Of `stride` rows the first is kept, of residuals the largest, so that
// no peak is lost. False when out of memory.
bool report_pack(FILE *stream, const comparison *c, size_t stride);

// Any text, as base64 of zlib. False when out of memory.
bool report_pack_text(FILE *stream, const char *text);

#endif
