// SPDX-License-Identifier: Apache-2.0
#include "../draw/escape.h"
#include "plot.h"
#include "plot_frame.h"

#include <float.h>
#include <math.h>

enum { KEY_FONT = 13, SAMPLE = 38, PADDING = 10, OFF_FRAME = 14 };

static const char *const line_names[PLOT_STYLES] = {"thin", "dashed", "dotted", "heavy",
                                                    "heavy-dashed"};
static const char *const fill_names[PLOT_FILLS] = {"light", "middle", "dark", "hatched", "white"};

static double entry_width(const plot_entry *e) {
  return SAMPLE + PADDING + 0.56 * KEY_FONT * draw_count_characters(e->text);
}

static double width_of(const plot_entry *entries, int count) {
  double most = 0;
  for (int i = 0; i < count; i++) most = fmax(most, entry_width(&entries[i]));
  return most + 2 * PADDING;
}

// Of the four corners, the one where the key covers least.
static draw_box place_key(const plot *p, double width, double height) {
  const double left = FRAME_LEFT + OFF_FRAME, right = FRAME_LEFT + FRAME_WIDTH - OFF_FRAME - width;
  const double top = FRAME_TOP + OFF_FRAME, bottom = FRAME_TOP + FRAME_HEIGHT - OFF_FRAME - height;
  const draw_point corners[] = {{right, top}, {right, bottom}, {left, top}, {left, bottom}};
  draw_box best = {{0, 0}, {0, 0}};
  double best_cost = DBL_MAX;
  for (int i = 0; i < 4; i++) {
    draw_box box = {corners[i], {corners[i].x + width, corners[i].y + height}};
    double cost = draw_box_cost(&p->obstacles, box);
    if (!(cost < best_cost)) continue;
    best = box;
    best_cost = cost;
  }
  return best;
}

static void put_entry(plot *p, const plot_entry *e, draw_point at) {
  if (e->is_area)
    fprintf(p->labels,
            "<rect class=\"%s\" x=\"%.1f\" y=\"%.1f\" width=\"%d\" height=\"12\" "
            "stroke=\"#000\" stroke-width=\"0.6\"/>\n",
            fill_names[e->fill], at.x, at.y - 6, SAMPLE);
  else
    fprintf(p->labels, "<path class=\"%s\" d=\"M%.1f %.1fh%d\"/>\n", line_names[e->style], at.x,
            at.y, SAMPLE);
  fprintf(p->labels, "<text class=\"on\" x=\"%.1f\" y=\"%.1f\">", at.x + SAMPLE + PADDING,
          at.y + 0.36 * KEY_FONT);
  draw_put_escaped(p->labels, e->text);
  fputs("</text>\n", p->labels);
}

void plot_key(plot *p, const plot_entry *entries, int count) {
  draw_box box = place_key(p, width_of(entries, count), count * KEY_LINE + PADDING);
  fprintf(p->labels,
          "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"#fff\" "
          "stroke=\"#000\" stroke-width=\"0.8\"/>\n",
          box.low.x, box.low.y, box.high.x - box.low.x, box.high.y - box.low.y);
  for (int i = 0; i < count; i++)
    put_entry(p, &entries[i],
              (draw_point){box.low.x + PADDING, box.low.y + 0.5 * PADDING + (i + 0.5) * KEY_LINE});
  draw_add_box(&p->obstacles, box);
}

// From the left, as many in a row as fit.
void plot_key_below(plot *p, const plot_entry *entries, int count) {
  const double left = 20, apart = 2.5 * PADDING; // pixels; the caption begins there too
  double x = left;
  for (int i = 0; i < count; i++) {
    double width = entry_width(&entries[i]);
    if (i == 0 || x + width > PLOT_WIDTH - left) {
      p->rows_below++;
      x = left;
    }
    put_entry(p, &entries[i], (draw_point){x, frame_key_row(p->rows_below - 1)});
    x += width + apart;
  }
}
