// SPDX-License-Identifier: Apache-2.0
#include "picture_internal.h"

#include <png.h>

void picture_fill_sky(unsigned char *rgb, const float *depth, picture_size size) {
  static const double top[3] = {0.62, 0.76, 0.90}, horizon[3] = {0.95, 0.97, 1};
  for (int row = 0; row < size.height; row++) {
    double share = (double)row / size.height; // GL's rows start at the bottom
    for (int column = 0; column < size.width; column++) {
      size_t pixel = (size_t)row * (size_t)size.width + (size_t)column;
      if (depth[pixel] < 1) continue;
      for (int k = 0; k < 3; k++)
        rgb[3 * pixel + k] = (unsigned char)(255 * (horizon[k] + share * (top[k] - horizon[k])));
    }
  }
}

void picture_halve(unsigned char *out, const unsigned char *rgb, picture_size size) {
  size_t stride = 3 * (size_t)size.width;
  int rows = size.height / 2, columns = size.width / 2;
  for (int row = 0; row < rows; row++) {
    const unsigned char *from = rgb + stride * (size_t)(2 * (rows - 1 - row));
    for (int i = 0; i < 3 * columns; i++) {
      const unsigned char *four = from + 6 * (i / 3) + i % 3;
      int sum = four[0] + four[3] + four[stride] + four[stride + 3];
      *out++ = (unsigned char)((sum + 2) / 4);
    }
  }
}

bool picture_put_png(FILE *out, const unsigned char *rgb, picture_size size) {
  png_image image = {.version = PNG_IMAGE_VERSION,
                     .width = (png_uint_32)size.width,
                     .height = (png_uint_32)size.height,
                     .format = PNG_FORMAT_RGB};
  bool written = png_image_write_to_stdio(&image, out, 0, rgb, 0, NULL) != 0;
  png_image_free(&image);
  return written || ferror(out);
}
