// SPDX-License-Identifier: Apache-2.0
// OSMesa, loaded on demand: it brings a compiler of 100 MB with it, which only pictures need.
#include "picture_internal.h"

#include <dlfcn.h>
#include <GL/osmesa.h>
#include <stdlib.h>

// Its functions; the types are those of the header.
typedef struct osmesa {
  __typeof__(OSMesaCreateContextAttribs) *create;
  __typeof__(OSMesaMakeCurrent) *make_current;
  __typeof__(OSMesaDestroyContext) *destroy;
} osmesa;

struct picture_gl {
  osmesa api;
  OSMesaContext context;
  unsigned char *buffer; // of the window that there is not
};

static bool find(void *out, void *library, const char *name) {
  // ISO C has no conversion from void * to a function: POSIX asks for this one.
  *(void **)out = dlsym(library, name);
  return *(void **)out != NULL;
}

// The library stays loaded: MuJoCo keeps pointers to its functions.
static bool load(osmesa *api, mjcf_error *error) {
  void *library = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL);
  if (!library) library = dlopen("libOSMesa.so", RTLD_NOW | RTLD_LOCAL);
  if (!library) {
    const char *why = dlerror();
    return mjcf_fail(error, "no OSMesa to render with (package libosmesa6)%s%s", why ? ": " : "",
                     why ? why : "");
  }
  if (find(&api->create, library, "OSMesaCreateContextAttribs") &&
      find(&api->make_current, library, "OSMesaMakeCurrent") &&
      find(&api->destroy, library, "OSMesaDestroyContext"))
    return true;
  return mjcf_fail(error, "this OSMesa lacks functions of OSMesa 11.2 to render with");
}

// MuJoCo 2.2 draws with the fixed pipeline of OpenGL 1.5: a compatibility profile.
static OSMesaContext create_context(const osmesa *api) {
  static const int attributes[] = {OSMESA_FORMAT,
                                   OSMESA_RGBA,
                                   OSMESA_DEPTH_BITS,
                                   24,
                                   OSMESA_STENCIL_BITS,
                                   8,
                                   OSMESA_PROFILE,
                                   OSMESA_COMPAT_PROFILE,
                                   0};
  return api->create(attributes, NULL);
}

picture_gl *picture_gl_create(picture_size size, mjcf_error *error) {
  picture_gl *gl = (picture_gl *)calloc(1, sizeof *gl);
  if (gl) gl->buffer = (unsigned char *)malloc(4 * (size_t)size.width * (size_t)size.height);
  if (!gl || !gl->buffer) {
    mjcf_fail(error, "out of memory for a picture");
  } else if (load(&gl->api, error)) {
    gl->context = create_context(&gl->api);
    if (gl->context &&
        gl->api.make_current(gl->context, gl->buffer, GL_UNSIGNED_BYTE, size.width, size.height))
      return gl;
    mjcf_fail(error, "OSMesa gives no OpenGL context");
  }
  picture_gl_free(gl);
  return NULL;
}

void picture_gl_free(picture_gl *gl) {
  if (!gl) return;
  if (gl->context) {
    gl->api.make_current(NULL, NULL, 0, 0, 0);
    gl->api.destroy(gl->context);
  }
  free(gl->buffer);
  free(gl);
}
