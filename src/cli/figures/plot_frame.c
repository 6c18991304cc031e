// SPDX-License-Identifier: Apache-2.0
#include "plot_frame.h"

#include "../draw/escape.h"

#include <math.h>
#include <string.h>

enum { TICK = 8, SMALL_TICK = 4, TITLE_GAP = 48, MOST_TICKS = 8 };

// A step of 1, 2 or 5 times a power of ten with at most MOST_TICKS steps over the axis; *parts of
// it are marked by small ticks.
static double tick_step(double range, int *parts) {
  static const struct {
    double step;
    int parts;
  } steps[] = {{1, 5}, {2, 4}, {5, 5}, {10, 5}};
  double power = pow(10, floor(log10(range / MOST_TICKS)));
  for (int i = 0; i < 4; i++) {
    *parts = steps[i].parts;
    if (range <= MOST_TICKS * steps[i].step * power * (1 + 1e-12)) return steps[i].step * power;
  }
  return 10 * power;
}

static void put_tick(FILE *out, draw_point at, double length, bool upright) {
  fprintf(out, "<path class=\"frame\" d=\"M%.2f %.2f%c%.2f\"/>\n", at.x, at.y, upright ? 'v' : 'h',
          length);
}

static void put_number(FILE *out, draw_point at, const char *anchor, double value) {
  // rounding of k * step would show as 0.30000000000000004; 0 + -0 is 0
  char text[32];
  snprintf(text, sizeof text, "%.10g", 0 + value);
  bool negative = text[0] == '-';
  fprintf(out, "<text x=\"%.2f\" y=\"%.2f\" text-anchor=\"%s\">%s%s</text>\n", at.x, at.y, anchor,
          negative ? "\u2212" : "", text + negative);
}

static void draw_x_ticks(const plot *p, FILE *out) {
  int parts;
  double step = tick_step(p->x.high - p->x.low, &parts), small = step / parts;
  double bottom = FRAME_TOP + FRAME_HEIGHT;
  for (double k = ceil(p->x.low / small - 1e-9); k * small <= p->x.high + 1e-9 * small; k++) {
    bool large = fmod(fabs(k), parts) == 0;
    double x = plot_pixel(p, (plot_point){k * small, p->y.low}).x, tick = large ? TICK : SMALL_TICK;
    put_tick(out, (draw_point){x, bottom}, -tick, true);
    put_tick(out, (draw_point){x, FRAME_TOP}, tick, true);
    if (large) put_number(out, (draw_point){x, bottom + 20}, "middle", k / parts * step);
  }
}

static void draw_y_ticks(const plot *p, FILE *out) {
  int parts;
  double step = tick_step(p->y.high - p->y.low, &parts), small = step / parts;
  double right = FRAME_LEFT + FRAME_WIDTH;
  for (double k = ceil(p->y.low / small - 1e-9); k * small <= p->y.high + 1e-9 * small; k++) {
    bool large = fmod(fabs(k), parts) == 0;
    double y = plot_pixel(p, (plot_point){p->x.low, k * small}).y, tick = large ? TICK : SMALL_TICK;
    put_tick(out, (draw_point){FRAME_LEFT, y}, tick, false);
    put_tick(out, (draw_point){right, y}, -tick, false);
    if (large)
      put_number(out, (draw_point){FRAME_LEFT - 8, y + 0.36 * PLOT_FONT}, "end", k / parts * step);
  }
}

static void put_title(FILE *out, const plot_title *t) {
  draw_put_escaped(out, t->words);
  if (*t->symbol) {
    fputs(" <tspan class=\"symbol\">", out);
    draw_put_escaped(out, t->symbol);
    fputs("</tspan>", out);
  }
  if (*t->subscript) {
    fputs("<tspan class=\"symbol\" dy=\"4\" font-size=\"11\">", out);
    draw_put_escaped(out, t->subscript);
    fputs("</tspan>", out);
  }
  fprintf(out, "<tspan dx=\"5\" dy=\"%d\">(", *t->subscript ? -4 : 0);
  draw_put_escaped(out, t->unit);
  fputs(")</tspan></text>\n", out);
}

void frame_draw(const plot *p, FILE *out) {
  fprintf(out, "<rect class=\"frame\" x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\"/>\n", FRAME_LEFT,
          FRAME_TOP, FRAME_WIDTH, FRAME_HEIGHT);
  draw_x_ticks(p, out);
  draw_y_ticks(p, out);
  double middle_x = FRAME_LEFT + 0.5 * FRAME_WIDTH, middle_y = FRAME_TOP + 0.5 * FRAME_HEIGHT;
  fprintf(out, "<text x=\"%.2f\" y=\"%d\" text-anchor=\"middle\">", middle_x,
          FRAME_TOP + FRAME_HEIGHT + TITLE_GAP);
  put_title(out, &p->x.title);
  fprintf(out, "<text transform=\"translate(%d %.2f) rotate(-90)\" text-anchor=\"middle\">", 26,
          middle_y);
  put_title(out, &p->y.title);
}

// Words of a line: as many as fit. Returns the length in bytes, blanks at its end left out.
static size_t line_length(const char *text) {
  // mean width of a character of DejaVu Sans in units of the font size
  const double room = (PLOT_WIDTH - 40) / (0.56 * CAPTION_FONT);
  size_t fits = 0, length = 0;
  double used = 0;
  for (; text[length]; length++) {
    if (text[length] == ' ') fits = length;
    used += ((unsigned char)text[length] & 0xC0) != 0x80;
    if (used > room && fits > 0) return fits;
  }
  return length;
}

// Symbols stand in braces and come out in italics.
static void put_marked(FILE *stream, const char *text, size_t length) {
  char part[512];
  for (size_t i = 0; i < length;) {
    bool symbol = text[i] == '{';
    size_t start = i + symbol, count = 0;
    while (start + count < length && text[start + count] != (symbol ? '}' : '{')) count++;
    snprintf(part, sizeof part, "%.*s", (int)count, text + start);
    if (symbol) fputs("<tspan class=\"symbol\">", stream);
    draw_put_escaped(stream, part);
    if (symbol) fputs("</tspan>", stream);
    i = start + count + symbol;
  }
}

double frame_key_row(int row) {
  return FRAME_TOP + FRAME_HEIGHT + TITLE_GAP + 26 + row * KEY_LINE;
}

// What a key takes away from the caption.
static int key_height(int rows) {
  const int gap = 6; // pixels
  return rows > 0 ? rows * KEY_LINE + gap : 0;
}

int frame_caption(const char *text, int key_rows, FILE *stream) {
  int lines = 0;
  while (*text) {
    size_t length = line_length(text);
    if (stream) {
      fprintf(stream, "<text class=\"caption\" x=\"20\" y=\"%d\">",
              FRAME_TOP + FRAME_HEIGHT + TITLE_GAP + 30 + key_height(key_rows) +
                  lines * CAPTION_LINE);
      put_marked(stream, text, length);
      fputs("</text>\n", stream);
    }
    lines++;
    text += length;
    while (*text == ' ') text++;
  }
  return lines;
}

double frame_total_height(int lines, int key_rows) {
  return FRAME_TOP + FRAME_HEIGHT + TITLE_GAP + 22 + key_height(key_rows) + lines * CAPTION_LINE;
}
