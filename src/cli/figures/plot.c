// SPDX-License-Identifier: Apache-2.0
#include "plot.h"

#include "../draw/escape.h"
#include "files/memory_stream.h"
#include "plot_frame.h"
#include "track.h"

#include <math.h>
#include <stdlib.h>

static const char style_sheet[] =
    "text { font-family: 'DejaVu Sans', Verdana, Arial, sans-serif; font-size: 15px; fill: #000; "
    "}\n"
    ".caption { font-size: 12px; }\n"
    ".on { font-size: 13px; }\n"
    ".symbol { font-family: 'DejaVu Serif', Georgia, serif; font-style: italic; }\n"
    ".frame { fill: none; stroke: #000; stroke-width: 1.1; }\n"
    ".thin, .dashed, .dotted, .heavy, .heavy-dashed { fill: none; stroke: #000;\n"
    "  stroke-width: 1.1; stroke-linejoin: round; }\n"
    ".dotted { stroke-dasharray: 1.5 3.5; stroke-linecap: round; }\n"
    ".heavy, .heavy-dashed { stroke-width: 2.2; }\n"
    ".heavy-dashed { stroke-dasharray: 9 5; }\n"
    ".light { fill: #e2e2e2; }\n"
    ".middle { fill: #b0b0b0; }\n"
    ".dark { fill: #5c5c5c; }\n"
    ".hatched { fill: url(#hatch); }\n"
    ".white { fill: #fff; }\n"
    // neighbouring cells of one fill must not show a seam
    ".area { shape-rendering: crispEdges; }\n"
    ".mark { fill: #000; }\n";

static const char hatch[] =
    "<pattern id=\"hatch\" width=\"6\" height=\"6\" patternUnits=\"userSpaceOnUse\" "
    "patternTransform=\"rotate(45)\"><rect width=\"6\" height=\"6\" fill=\"#fff\"/>"
    "<path d=\"M0 0V6\" stroke=\"#000\" stroke-width=\"1.2\"/></pattern>\n";

static const char *const style_names[PLOT_STYLES] = {"thin", "dashed", "dotted", "heavy",
                                                     "heavy-dashed"};
static const char *const fill_names[PLOT_FILLS] = {"light", "middle", "dark", "hatched", "white"};

bool plot_open(plot *p, const plot_axis *x, const plot_axis *y) {
  *p = (plot){.x = *x, .y = *y};
  p->areas = bike_memory_stream(&p->text[0], &p->size[0]);
  p->lines = bike_memory_stream(&p->text[1], &p->size[1]);
  p->labels = bike_memory_stream(&p->text[2], &p->size[2]);
  p->gaps = bike_memory_stream(&p->text[3], &p->size[3]);
  return p->areas && p->lines && p->labels && p->gaps;
}

void plot_close(plot *p) {
  FILE *layers[] = {p->areas, p->lines, p->labels, p->gaps};
  for (int i = 0; i < PLOT_LAYERS; i++) {
    if (layers[i]) fclose(layers[i]);
    free(p->text[i]);
  }
  draw_obstacles_free(&p->obstacles);
}

static bool is_whole(FILE *layer) {
  return fflush(layer) == 0 && !ferror(layer);
}

// Clipping to the frame, gaps for the labels, hatching.
static void put_definitions(const plot *p, const char *id, FILE *stream) {
  const char *box = "x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\"";
  fprintf(stream, "<defs>%s<clipPath id=\"%s-frame\"><rect ", hatch, id);
  fprintf(stream, box, FRAME_LEFT, FRAME_TOP, FRAME_WIDTH, FRAME_HEIGHT);
  fprintf(stream, "/></clipPath>\n<mask id=\"%s-gaps\" maskUnits=\"userSpaceOnUse\" ", id);
  fprintf(stream, box, FRAME_LEFT, FRAME_TOP, FRAME_WIDTH, FRAME_HEIGHT);
  fputs("><rect ", stream);
  fprintf(stream, box, FRAME_LEFT, FRAME_TOP, FRAME_WIDTH, FRAME_HEIGHT);
  fprintf(stream, " fill=\"#fff\"/>\n%s</mask></defs>\n", p->text[3]);
}

bool plot_write(plot *p, const char *id, const char *title, const char *caption, FILE *stream) {
  if (!is_whole(p->areas) || !is_whole(p->lines) || !is_whole(p->labels) || !is_whole(p->gaps) ||
      p->obstacles.lost)
    return false;
  double height = frame_total_height(frame_caption(caption, p->rows_below, NULL), p->rows_below);
  fprintf(stream,
          "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%.0f\" "
          "viewBox=\"0 0 %d %.0f\" role=\"img\">\n<title>",
          PLOT_WIDTH, height, PLOT_WIDTH, height);
  draw_put_escaped(stream, title);
  fprintf(stream, "</title>\n<style>\n%s.dashed { stroke-dasharray: %d %d; }\n</style>\n",
          style_sheet, PLOT_DASH, PLOT_DASH_SPACE);
  put_definitions(p, id, stream);
  fprintf(stream, "<rect width=\"%d\" height=\"%.0f\" fill=\"#fff\"/>\n", PLOT_WIDTH, height);
  fprintf(stream, "<g clip-path=\"url(#%s-frame)\">\n%s<g mask=\"url(#%s-gaps)\">\n%s</g></g>\n",
          id, p->text[0], id, p->text[1]);
  frame_draw(p, stream);
  fputs(p->text[2], stream);
  frame_caption(caption, p->rows_below, stream);
  fputs("</svg>\n", stream);
  return true;
}

draw_point plot_pixel(const plot *p, plot_point at) {
  double x = (at.x - p->x.low) / (p->x.high - p->x.low);
  double y = (at.y - p->y.low) / (p->y.high - p->y.low);
  return (draw_point){FRAME_LEFT + x * FRAME_WIDTH, FRAME_TOP + (1 - y) * FRAME_HEIGHT};
}

bool plot_inside(const plot *p, plot_point at) {
  return at.x >= p->x.low && at.x <= p->x.high && at.y >= p->y.low && at.y <= p->y.high;
}

static void put_path(const plot *p, FILE *out, const char *style, const plot_point *points,
                     int count, bool closed) {
  fprintf(out, "<path class=\"%s\" d=\"", style);
  for (int i = 0; i < count; i++) {
    draw_point at = plot_pixel(p, points[i]);
    fprintf(out, "%c%.2f %.2f", i ? 'L' : 'M', at.x, at.y);
  }
  fprintf(out, "%s\"/>\n", closed ? "Z" : "");
}

void plot_line(plot *p, plot_style style, const plot_point *points, int count) {
  if (count < 2) return;
  put_path(p, p->lines, style_names[style], points, count, false);
  plot_reserve_line(p, points, count);
}

void plot_reserve_line(plot *p, const plot_point *points, int count) {
  for (int i = 1; i < count; i++)
    if (plot_inside(p, points[i]) || plot_inside(p, points[i - 1]))
      draw_add_segment(&p->obstacles, plot_pixel(p, points[i - 1]), plot_pixel(p, points[i]));
}

// The part of a curve between two lengths.
static void put_part(plot *p, plot_style style, const track *t, double from, double to) {
  if (!(to > from)) return;
  draw_point a = track_point(t, from), b = track_point(t, to);
  fprintf(p->lines, "<path class=\"%s\" d=\"M%.2f %.2f", style_names[style], a.x, a.y);
  for (int i = 0; i < t->count; i++)
    if (t->length[i] > from && t->length[i] < to)
      fprintf(p->lines, "L%.2f %.2f", t->at[i].x, t->at[i].y);
  fprintf(p->lines, "L%.2f %.2f\"/>\n", b.x, b.y);
}

void plot_interrupted_line(plot *p, plot_style style, const plot_point *points, int count,
                           const plot_gaps *gaps) {
  track t;
  if (count < 2) return;
  if (track_make(&t, p, points, count)) {
    double from = 0;
    for (int i = 0; i < gaps->count; i++) {
      put_part(p, style, &t, from, gaps->at[i] - 0.5 * gaps->width);
      from = gaps->at[i] + 0.5 * gaps->width;
    }
    put_part(p, style, &t, from, track_total(&t));
  } else {
    p->obstacles.lost = true;
  }
  track_free(&t);
}

void plot_area(plot *p, plot_fill fill, const plot_point *points, int count) {
  char style[32];
  snprintf(style, sizeof style, "area %s", fill_names[fill]);
  put_path(p, p->areas, style, points, count, true);
}

void plot_arrow_x(plot *p, double x) {
  draw_point at = plot_pixel(p, (plot_point){x, p->y.low});
  if (!plot_inside(p, (plot_point){x, p->y.low})) return;
  fprintf(p->labels, "<path class=\"mark\" d=\"M%.2f %.2fl-5 12h4v16h2v-16h4z\"/>\n", at.x,
          at.y - 28);
  draw_add_box(&p->obstacles, (draw_box){{at.x - 8, at.y - 32}, {at.x + 8, at.y}});
}

void plot_arrow_y(plot *p, double y) {
  draw_point at = plot_pixel(p, (plot_point){p->x.low, y});
  if (!plot_inside(p, (plot_point){p->x.low, y})) return;
  fprintf(p->labels, "<path class=\"mark\" d=\"M%.2f %.2fl-12 -5v4h-16v2h16v4z\"/>\n", at.x + 28,
          at.y);
  draw_add_box(&p->obstacles, (draw_box){{at.x, at.y - 8}, {at.x + 32, at.y + 8}});
}

void plot_dot(plot *p, plot_point at) {
  draw_point pixel = plot_pixel(p, at);
  fprintf(p->labels, "<circle class=\"mark\" cx=\"%.2f\" cy=\"%.2f\" r=\"3.5\"/>\n", pixel.x,
          pixel.y);
}
