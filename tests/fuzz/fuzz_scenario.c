// SPDX-License-Identifier: Apache-2.0
// Scenarios, with a bicycle, a MuJoCo model, inputs and shared gates beside them.
#include "fuzz.h"

#include "scenario.h"

#include <math.h>
#include <string.h>

static void require_limits(const scenario *s) {
  for (size_t i = 0; i < s->rules.count; i++) {
    const gate_rule *r = &s->rules.items[i];
    FUZZ_REQUIRE(r->information || (isfinite(r->limit) && r->limit >= 0), "limit %g", r->limit);
    FUZZ_REQUIRE(r->from >= 0 && r->to <= s->duration * (1 + 1e-9), "%g to %g", r->from, r->to);
    FUZZ_REQUIRE(r->layer && *r->metric, "gate %zu", i);
  }
}

static void require_meaning(const scenario *s) {
  FUZZ_REQUIRE(s->duration > 0 && isfinite(s->duration), "%g s", s->duration);
  FUZZ_REQUIRE(s->sample > 0 && s->sample <= s->duration, "%g s", s->sample);
  FUZZ_REQUIRE(fabs(s->start.lean) < scenario_lean_limit(), "%g rad", s->start.lean);
  FUZZ_REQUIRE(fabs(s->start.steer) <= 200 * M_PI, "%g rad", s->start.steer);
  FUZZ_REQUIRE(isfinite(s->start.speed + s->start.lean_rate + s->start.steer_rate), "start");
  FUZZ_REQUIRE(s->reference.engine && s->candidate.engine, "engines");
  FUZZ_REQUIRE(s->instants.slow <= s->instants.fast, "%g m/s", s->instants.slow);
  FUZZ_REQUIRE(s->convergence.count <= SCENARIO_MAX_STEPS, "%d steps", s->convergence.count);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static scenario s;
  static bool prepared;
  problem p = {""};
  if (!prepared) {
    fuzz_copy("bicycle.yml", "model/benchmark/benchmark.yml");
    fuzz_copy("model.xml", "validate/scenarios/models/somebodys_bicycle.xml");
    fuzz_copy("input.csv", "validate/scenarios/inputs/sway.csv");
    fuzz_copy("gates.yml", "validate/scenarios/gates/exact_rolling.yml");
    prepared = true;
  }
  const char *path = fuzz_write("scenario.yml", data, size);
  if (scenario_read(&s, path, &p) != TERM_DONE) {
    FUZZ_REQUIRE(fuzz_one_line(p.text), "'%s'", p.text);
    return 0;
  }
  require_limits(&s);
  require_meaning(&s);
  scenario_clear(&s);
  return 0;
}
