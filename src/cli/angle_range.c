// SPDX-License-Identifier: Apache-2.0
#include "angle_range.h"

#include <stdio.h>
#include <string.h>

bool cli_parse_angle_range(term_range *out, const char *text) {
  char copy[128]; // three numbers with room for all their zeros
  if (snprintf(copy, sizeof copy, "%s", text) >= (int)sizeof copy) return false;
  char *second = strchr(copy, ':');
  char *third = second ? strchr(second + 1, ':') : NULL;
  if (!third) return false;
  *second++ = *third++ = '\0';
  term_range range;
  if (!term_parse_angle(&range.first, copy) || !term_parse_angle(&range.last, second) ||
      !term_parse_integer(&range.count, third, 1, TERM_MAX_RANGE))
    return false;
  bool one_point = range.first == range.last;
  if (range.first > range.last || one_point != (range.count == 1)) return false;
  *out = range;
  return true;
}
