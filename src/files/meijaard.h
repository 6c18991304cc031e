// SPDX-License-Identifier: Apache-2.0
// Meijaard's symbols as they are read, from whichever form of file.
#ifndef FILES_MEIJAARD_H
#define FILES_MEIJAARD_H

#include <bicycle/file.h>

// Places of the 26 symbols in bike_meijaard_symbols.
enum {
  MEIJAARD_W,
  MEIJAARD_C,
  MEIJAARD_LAM,
  MEIJAARD_G,
  MEIJAARD_RR,
  MEIJAARD_MR,
  MEIJAARD_IRXX,
  MEIJAARD_IRYY,
  MEIJAARD_XB,
  MEIJAARD_ZB,
  MEIJAARD_MB,
  MEIJAARD_IBXX,
  MEIJAARD_IBYY,
  MEIJAARD_IBZZ,
  MEIJAARD_IBXZ,
  MEIJAARD_XH,
  MEIJAARD_ZH,
  MEIJAARD_MH,
  MEIJAARD_IHXX,
  MEIJAARD_IHYY,
  MEIJAARD_IHZZ,
  MEIJAARD_IHXZ,
  MEIJAARD_RF,
  MEIJAARD_MF,
  MEIJAARD_IFXX,
  MEIJAARD_IFYY,
  // read besides them
  MEIJAARD_YB = BIKE_MEIJAARD_COUNT,
  MEIJAARD_YH, // lateral positions, right positive
  MEIJAARD_IRZZ,
  MEIJAARD_IFZZ, // must equal IRxx, IFxx
  MEIJAARD_ALL
};

// The rider's part of the rear frame B: the point mass that a rider offset displaces.
typedef struct bike_rider_share {
  bool given;         //
  int line;           // in the file
  double mass;        // kg
  double position[3]; // m, (x forward, y right, z down), as Meijaard's
} bike_rider_share;

typedef struct bike_symbols {
  double value[MEIJAARD_ALL];
  double sigma[MEIJAARD_ALL]; // standard uncertainty, 0 where none is given
  int line[MEIJAARD_ALL];     // 0: not in the file
  double steer_damping;       // N m s/rad
  bike_rider_share rider;
} bike_symbols;

// The place of a symbol, -1 for one that is read and not used, -2 for an unknown one.
int bike_symbol_index(const char *name);
enum { BIKE_SYMBOL_UNUSED = -1, BIKE_SYMBOL_UNKNOWN = -2 };

// And back, for the place of a symbol that is used.
const char *bike_symbol_name(int index);

// Checks what was read (complete, in range) and makes the bicycle of it; `path` and `error` are for
// messages with the symbol's line.
int bike_symbols_to_file(bike_file *out, const bike_symbols *symbols, const char *path,
                         bike_file_error *error);

// Writes why the library's check refuses a bicycle, if it does. `line_of` gives the line and may
// change the key (NULL at first) for the part's index (-1: the bicycle) and the rule's first word.
typedef int bike_line_function(int part, const char *rule, const char **key, const void *user);
int bike_report_check(const bike_bicycle *bicycle, const char *path, bike_line_function *line_of,
                      const void *user, bike_file_error *error);

#endif
