// SPDX-License-Identifier: Apache-2.0
#include <bicycle/error.h>

const char *bike_error_string(int code) {
  switch (code) {
#define BIKE_ERROR_TEXT(name, text)                                                                \
  case name:                                                                                       \
    return text;
    BIKE_ERRORS(BIKE_ERROR_TEXT)
#undef BIKE_ERROR_TEXT
  default:
    return "unknown error code";
  }
}
