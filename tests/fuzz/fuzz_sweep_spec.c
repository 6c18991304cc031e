// SPDX-License-Identifier: Apache-2.0
// Specs of sweeps. What is accepted has points, and each of them is a bicycle or a reason.
#include "fuzz.h"

#include "sweep/point.h"

#include <bicycle/error.h>
#include <math.h>

static void require_point(const sweep_spec *spec, long index) {
  static sweep_point point;
  sweep_point_at(&point, spec, index);
  FUZZ_REQUIRE((point.code == BIKE_OK) == (point.error[0] == '\0'), "code %d, '%s'", point.code,
               point.error);
  for (int i = 0; i < spec->axis_count; i++)
    FUZZ_REQUIRE(isfinite(point.values[i]), "%s is %g", spec->axes[i].name, point.values[i]);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static sweep_spec spec;
  static bool prepared;
  bike_file_error error = {""};
  if (!prepared) fuzz_copy("bicycle.yml", "model/benchmark/benchmark.yml");
  prepared = true;
  const char *path = fuzz_write("sweep.yml", data, size);
  int code = sweep_spec_read(&spec, path, &error);
  FUZZ_REQUIRE(code == BIKE_OK || fuzz_one_line(error.text), "'%s'", error.text);
  if (code == BIKE_OK) {
    FUZZ_REQUIRE(spec.points >= 1 && spec.points <= SWEEP_MOST_POINTS, "%ld", spec.points);
    FUZZ_REQUIRE(spec.output_count >= 1 && spec.axis_count <= SWEEP_MOST_AXES, "outputs");
    require_point(&spec, 0);
    require_point(&spec, spec.points / 2);
    require_point(&spec, spec.points - 1);
  }
  sweep_spec_free(&spec);
  return 0;
}
