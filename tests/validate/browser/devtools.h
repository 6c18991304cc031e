// SPDX-License-Identifier: Apache-2.0
// A headless Chromium, driven over the pipe of its DevTools protocol: real mouse events, the page's
// console, every request it makes. Needs nothing but the browser.
#ifndef TESTS_BROWSER_DEVTOOLS_H
#define TESTS_BROWSER_DEVTOOLS_H

#include <jansson.h>
#include <stdbool.h>

typedef struct devtools devtools;

// How a page is looked at.
typedef struct devtools_view {
  int width, height;
  bool dark, scripts;
} devtools_view;

// Starts the browser with a fresh profile in `folder`. The test fails where it does not start.
devtools *devtools_start(const char *program, const char *folder);

// Ends the browser.
void devtools_stop(devtools *d);

// Opens an address in a new tab and waits until it is loaded; forgets what was counted before.
void devtools_open(devtools *d, const char *address, const devtools_view *view);

// The value of an expression, promises awaited; json_decref it. The test fails if it throws.
json_t *devtools_evaluate(devtools *d, const char *expression);

// The same as a truth value, as a number.
bool devtools_true(devtools *d, const char *expression);
double devtools_number(devtools *d, const char *expression);

// Waits until an expression holds; the test fails after ten seconds.
void devtools_wait(devtools *d, const char *expression);

// Moves the mouse to the middle of a piece of an element, scrolled into view: `share` of its width;
// `click` presses the button there.
void devtools_point(devtools *d, const char *selector, double share, bool click);

// Saves a picture of the whole page.
void devtools_picture(devtools *d, const char *path);

// Errors and warnings of the console, exceptions, and requests beside the page itself, since it was
// opened; one a line, empty if there was nothing.
const char *devtools_complaints(devtools *d);

#endif
