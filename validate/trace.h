// SPDX-License-Identifier: Apache-2.0
// A ride as an engine recorded it: rows at k * sample, and how it ended.
#ifndef VALIDATE_TRACE_H
#define VALIDATE_TRACE_H

#include <bicycle/ride.h>
#include <stdint.h>

// What every engine says of a moment. Index 0: rear, 1: front wheel.
typedef struct trace_row {
  bike_sample sample;    //
  bike_sample_more more; //
  double slip[2];        // m/s  horizontal speed of the wheel's material at its contact
  double height[2];      // m    of the wheel's lowest point above the ground
} trace_row;

// Every column of `bicycle ride` after time, and what only the comparator looks at. The first of
// them are the motion: position, angles, rates and speed.
enum { TRACE_SIGNAL_COUNT = 27, TRACE_MOTION_COUNT = 11 };

// Where a recording first holds no finite number for a signal.
typedef struct trace_flaw {
  size_t row;  //
  char *place; // "ride.csv:3: roll [deg]", allocated; NULL: nowhere
} trace_flaw;

typedef struct trace {
  trace_row *rows;
  size_t count, room;
  bool has_contacts;    // slip and height are measured, not zero by construction
  uint64_t missing;     // bit k: trace_signals[k] is not known to the engine, its numbers are NaN
  bool complete;        // the whole duration was ridden
  double end_time;      // s
  bike_event end_event; // what ended the ride where it is not complete
  const char *ending; // the same in words, of an engine with endings of its own; NULL: the event's
  long steps;         // of the integrator; 0 of an engine that does not say
  long evaluations;   // of the right-hand sides; as steps
  double wall_time;   // s    of the integrator, elapsed
  double cpu_time;    // s    of that the time for which it had a processor
  trace_flaw flaws[TRACE_SIGNAL_COUNT]; // of an engine that plays what others have recorded
} trace;

// Appends a row; false when out of memory.
bool trace_add(trace *t, const trace_row *row);
void trace_clear(trace *t);

// Makes the numbers of all signals that are missing NaN.
void trace_blank_missing(trace *t);

// In words; NULL of a ride that is complete.
const char *trace_ending(const trace *t);

// Notes how the ride ended; `events` are those of the engine, in order of time.
void trace_end(trace *t, bool complete, double end_time, const bike_event *events, int count);

// One quantity of a row. A trace column of numbers is an array of rows of which one member counts.
typedef struct trace_signal {
  const char *name;
  const char *unit;
  size_t offset; // of a double within trace_row
} trace_signal;

extern const trace_signal trace_signals[TRACE_SIGNAL_COUNT];

const trace_signal *trace_find_signal(const char *name);

// Slip and height of the wheels, which only a trace with has_contacts has.
bool trace_is_contact(const trace_signal *signal);

bool trace_has(const trace *t, const trace_signal *signal);
double trace_value(const trace_row *row, const trace_signal *signal);

// Index of the first row in which a number is not finite, or -1. Friction (a quotient of forces)
// is left out: it is not finite where a wheel carries nothing. So are signals with a known flaw.
long trace_first_not_finite(const trace *t);

#endif
