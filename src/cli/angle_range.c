// SPDX-License-Identifier: Apache-2.0
#include "angle_range.h"

#include "terminal/command.h"

#include <math.h>

static bool keeps(const term_range *range, const cli_angle_bounds *bounds) {
  bool above = bounds->from_low ? range->first >= bounds->low : range->first > bounds->low;
  return above && range->last < bounds->high && range->count >= bounds->least &&
         range->count <= bounds->most;
}

term_range cli_angle_range_of(const char *option, const char *text,
                              const cli_angle_bounds *bounds) {
  const double degrees = 180 / M_PI;
  term_range range;
  if (!term_parse_angle_range(&range, text) || !keeps(&range, bounds))
    term_usage("%s: '%s' is not A:B:N, N angles (%ld to %ld) from A %s %gdeg to B < %gdeg, B > A%s",
               option, text, bounds->least, bounds->most, bounds->from_low ? ">=" : ">",
               bounds->low * degrees, bounds->high * degrees,
               bounds->least == 1 ? " (one: A:A:1)" : "");
  return range;
}
