// SPDX-License-Identifier: Apache-2.0
#include "csv.h"

#include "number.h"

void bike_csv_write_names(FILE *stream, const char *const names[], int count) {
  for (int i = 0; i < count; ++i) fprintf(stream, "%s%s", i ? "," : "", names[i]);
  fputc('\n', stream);
}

void bike_csv_write_row(FILE *stream, const double values[], int count) {
  for (int i = 0; i < count; ++i) {
    char text[BIKE_NUMBER_SIZE];
    bike_number_print(text, values[i]);
    fprintf(stream, "%s%s", i ? "," : "", text);
  }
  fputc('\n', stream);
}
