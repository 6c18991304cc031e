// SPDX-License-Identifier: Apache-2.0
#include "canvas.h"

#include "escape.h"
#include "files/memory_stream.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char style_sheet[] =
    "text { font-family: 'DejaVu Sans', Verdana, Arial, sans-serif; fill: #1b1f24;\n"
    "  paint-order: stroke; stroke: #fff; stroke-width: 4px; stroke-linejoin: round; }\n"
    "line, path, circle { fill: none; stroke-linecap: round; }\n"
    ".symbol { font-family: 'DejaVu Serif', Georgia, serif; font-style: italic; }\n"
    ".title { font-weight: bold; }\n"
    ".ground { stroke: #57606a; stroke-width: 2; }\n"
    ".hatch { stroke: #b6bdc5; stroke-width: 1; }\n"
    ".tyre { stroke: #2d333b; stroke-width: 6; }\n"
    ".rim { stroke: #8c959f; stroke-width: 1; }\n"
    ".spoke { stroke: #dfe3e8; stroke-width: 1; }\n"
    ".rear { stroke: #0b62b0; stroke-width: 5; }\n"
    ".front { stroke: #bc4c00; stroke-width: 5; }\n"
    ".hub { fill: #fff; stroke: #2d333b; stroke-width: 2; }\n"
    ".axis { stroke: #1b1f24; stroke-width: 1.3; stroke-dasharray: 16 4 2 4; }\n"
    ".helper { stroke: #9aa3ad; stroke-width: 0.9; }\n"
    ".upright { stroke: #57606a; stroke-width: 1; stroke-dasharray: 5 4; }\n"
    ".dimension { stroke: #1b1f24; stroke-width: 1.1; }\n"
    ".arrow { fill: #1b1f24; stroke: none; }\n"
    ".mass-back { fill: #fff; stroke: none; }\n"
    ".mass-edge { stroke: #1b1f24; stroke-width: 1.3; }\n"
    ".mass-fill { fill: #1b1f24; stroke: none; }\n"
    ".leader { stroke: #57606a; stroke-width: 0.8; }\n";

enum { MARGIN = 24 }; // pixels around all that is drawn

bool draw_open(draw_canvas *canvas) {
  *canvas = (draw_canvas){.bounds = {{DBL_MAX, DBL_MAX}, {-DBL_MAX, -DBL_MAX}}};
  canvas->body = bike_memory_stream(&canvas->text, &canvas->size);
  return canvas->body != NULL;
}

void draw_close(draw_canvas *canvas) {
  if (canvas->body) fclose(canvas->body);
  free(canvas->text);
  draw_obstacles_free(&canvas->obstacles);
}

static void include(draw_canvas *canvas, draw_point point) {
  draw_box *bounds = &canvas->bounds;
  bounds->low.x = fmin(bounds->low.x, point.x);
  bounds->low.y = fmin(bounds->low.y, point.y);
  bounds->high.x = fmax(bounds->high.x, point.x);
  bounds->high.y = fmax(bounds->high.y, point.y);
}

bool draw_write(draw_canvas *canvas, const char *title, FILE *stream) {
  if (fflush(canvas->body) != 0 || ferror(canvas->body) || canvas->obstacles.lost) return false;
  double left = canvas->bounds.low.x - MARGIN, top = canvas->bounds.low.y - MARGIN;
  double width = canvas->bounds.high.x + MARGIN - left;
  double height = canvas->bounds.high.y + MARGIN - top;
  fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n", stream);
  fprintf(stream,
          "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" "
          "viewBox=\"%.2f %.2f %.2f %.2f\">\n<title>",
          width, height, left, top, width, height);
  draw_put_escaped(stream, title);
  fprintf(stream, "</title>\n<style>\n%s</style>\n", style_sheet);
  fprintf(stream, "<rect x=\"%.2f\" y=\"%.2f\" width=\"%.2f\" height=\"%.2f\" fill=\"#fff\"/>\n",
          left, top, width, height);
  fputs(canvas->text, stream);
  fputs("</svg>\n", stream);
  return true;
}

void draw_faint_line(draw_canvas *canvas, const char *style, draw_point a, draw_point b) {
  fprintf(canvas->body, "<line class=\"%s\" x1=\"%.2f\" y1=\"%.2f\" x2=\"%.2f\" y2=\"%.2f\"/>\n",
          style, a.x, a.y, b.x, b.y);
  include(canvas, a);
  include(canvas, b);
}

void draw_line(draw_canvas *canvas, const char *style, draw_point a, draw_point b) {
  draw_faint_line(canvas, style, a, b);
  draw_add_segment(&canvas->obstacles, a, b);
}

void draw_circle(draw_canvas *canvas, const char *style, draw_point centre, double radius) {
  enum { SIDES = 48 }; // as an obstacle: off the circle by 0.2 % of its radius
  fprintf(canvas->body, "<circle class=\"%s\" cx=\"%.2f\" cy=\"%.2f\" r=\"%.2f\"/>\n", style,
          centre.x, centre.y, radius);
  include(canvas, (draw_point){centre.x - radius, centre.y - radius});
  include(canvas, (draw_point){centre.x + radius, centre.y + radius});
  draw_point last = {centre.x + radius, centre.y};
  for (int i = 1; i <= SIDES; i++) {
    double angle = 2 * M_PI * i / SIDES;
    draw_point next = {centre.x + radius * cos(angle), centre.y + radius * sin(angle)};
    draw_add_segment(&canvas->obstacles, last, next);
    last = next;
  }
}

void draw_arc(draw_canvas *canvas, const char *style, draw_point centre, draw_point a,
              draw_point b) {
  double radius = draw_distance(centre, a);
  fprintf(canvas->body, "<path class=\"%s\" d=\"M%.2f %.2fA%.2f %.2f 0 0 1 %.2f %.2f\"/>\n", style,
          a.x, a.y, radius, radius, b.x, b.y);
  include(canvas, a);
  include(canvas, b);
  draw_add_segment(&canvas->obstacles, a, b);
}

void draw_polygon(draw_canvas *canvas, const char *style, const draw_point *points, int count) {
  fprintf(canvas->body, "<path class=\"%s\" d=\"", style);
  for (int i = 0; i < count; i++) {
    fprintf(canvas->body, "%c%.2f %.2f", i ? 'L' : 'M', points[i].x, points[i].y);
    include(canvas, points[i]);
  }
  fputs("Z\"/>\n", canvas->body);
}

void draw_quarter(draw_canvas *canvas, const char *style, draw_point centre, double radius,
                  int quarter) {
  // Ends of the quarter's arc, clockwise on the screen from the top.
  static const draw_point ends[5] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  draw_point a = draw_along(centre, ends[quarter], radius);
  draw_point b = draw_along(centre, ends[quarter + 1], radius);
  fprintf(canvas->body,
          "<path class=\"%s\" d=\"M%.2f %.2fL%.2f %.2fA%.2f %.2f 0 0 1 %.2f %.2fZ\"/>\n", style,
          centre.x, centre.y, a.x, a.y, radius, radius, b.x, b.y);
}

draw_box draw_label_box(draw_point middle, const draw_label *label) {
  // Mean widths of the characters of DejaVu in units of the font size, on the safe side.
  double width = DRAW_FONT_SIZE * (0.66 * draw_count_characters(label->symbol) +
                                   0.48 * draw_count_characters(label->subscript) +
                                   0.57 * draw_count_characters(label->rest));
  double half_width = width / 2 + 3, half_height = 0.62 * DRAW_FONT_SIZE + 2;
  return (draw_box){{middle.x - half_width, middle.y - half_height},
                    {middle.x + half_width, middle.y + half_height}};
}

void draw_text(draw_canvas *canvas, draw_point middle, const draw_label *label) {
  FILE *out = canvas->body;
  fprintf(out, "<text x=\"%.2f\" y=\"%.2f\" font-size=\"%d\" text-anchor=\"middle\">", middle.x,
          middle.y + 0.36 * DRAW_FONT_SIZE, DRAW_FONT_SIZE); // the baseline is below the middle
  if (*label->symbol) {
    fputs("<tspan class=\"symbol\">", out);
    draw_put_escaped(out, label->symbol);
    fputs("</tspan>", out);
  }
  if (*label->subscript) {
    fputs("<tspan dy=\"4\" font-size=\"11\">", out);
    draw_put_escaped(out, label->subscript);
    fputs("</tspan>", out);
  }
  fprintf(out, "<tspan dx=\"%d\" dy=\"%d\">", *label->symbol ? 5 : 0, *label->subscript ? -4 : 0);
  draw_put_escaped(out, label->rest);
  fputs("</tspan></text>\n", out);
  draw_box box = draw_label_box(middle, label);
  include(canvas, box.low);
  include(canvas, box.high);
  draw_add_box(&canvas->obstacles, box);
}

draw_point draw_text_best(draw_canvas *canvas, const draw_point *middles, int count,
                          const draw_label *label) {
  // An earlier place is worth this much of the cost of what is in the way.
  static const double preference = 1.5;
  int best = 0;
  double best_cost = DBL_MAX;
  for (int i = 0; i < count; i++) {
    double cost =
        draw_box_cost(&canvas->obstacles, draw_label_box(middles[i], label)) + preference * i;
    if (cost < best_cost) {
      best_cost = cost;
      best = i;
    }
  }
  draw_text(canvas, middles[best], label);
  return middles[best];
}

void draw_title(draw_canvas *canvas, draw_point left, const char *text) {
  fprintf(canvas->body, "<text class=\"title\" x=\"%.2f\" y=\"%.2f\" font-size=\"%d\">", left.x,
          left.y, DRAW_TITLE_SIZE);
  draw_put_escaped(canvas->body, text);
  fputs("</text>\n", canvas->body);
  include(canvas, (draw_point){left.x, left.y - DRAW_TITLE_SIZE});
  include(canvas,
          (draw_point){left.x + 0.7 * DRAW_TITLE_SIZE * draw_count_characters(text), left.y});
}
