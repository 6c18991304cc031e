// SPDX-License-Identifier: Apache-2.0
#include "devtools.h"

#include "support/near.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { ANSWER_MILLISECONDS = 60000, WAIT_MILLISECONDS = 10000, COMPLAINTS = 4096 };

struct devtools {
  pid_t process;
  int to, from; // ends of the pipes
  int last_id;
  char *input; // bytes that have arrived, not yet taken
  size_t size, room;
  char *session;
  const char *address;
  char complaints[COMPLAINTS];
};

// The child reads commands on 3 and answers on 4, as --remote-debugging-pipe wants it.
static void run_browser(const char *program, const char *folder, int in, int out) {
  char profile[512];
  snprintf(profile, sizeof profile, "--user-data-dir=%s", folder);
  // Above 4 first, so that neither end overwrites the other.
  int high_in = fcntl(in, F_DUPFD, 10), high_out = fcntl(out, F_DUPFD, 10);
  int silence = open("/dev/null", O_WRONLY);
  if (dup2(high_in, 3) < 0 || dup2(high_out, 4) < 0 || dup2(silence, 2) < 0) _exit(126);
  for (int i = 5; i < 256; i++) close(i);
  execlp(program, program, "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic",
         "--no-first-run", "--disable-background-networking", "--disable-component-update",
         "--disable-sync", "--disable-dev-shm-usage", "--hide-scrollbars",
         "--host-resolver-rules=MAP * ~NOTFOUND", "--remote-debugging-pipe", profile, "about:blank",
         (char *)NULL);
  _exit(127);
}

devtools *devtools_start(const char *program, const char *folder) {
  int commands[2], answers[2];
  devtools *d = calloc(1, sizeof *d);
  assert_non_null(d);
  assert_int_equal(pipe(commands), 0);
  assert_int_equal(pipe(answers), 0);
  signal(SIGPIPE, SIG_IGN); // a browser that has died is seen by the read that ends
  d->process = fork();
  assert_true(d->process >= 0);
  if (d->process == 0) {
    setpgid(0, 0);
    run_browser(program, folder, commands[0], answers[1]);
  }
  close(commands[0]);
  close(answers[1]);
  d->to = commands[1];
  d->from = answers[0];
  return d;
}

void devtools_stop(devtools *d) {
  int status;
  close(d->to); // the browser ends when its pipe does
  close(d->from);
  for (int i = 0; i < 50 && waitpid(d->process, &status, WNOHANG) == 0; i++) {
    nanosleep(&(struct timespec){.tv_nsec = 100000000}, NULL);
    if (i == 40) kill(-d->process, SIGKILL); // the group is this browser's own
  }
  free(d->input);
  free(d->session);
  free(d);
}

static void send_message(devtools *d, json_t *message) {
  char *text = json_dumps(message, JSON_COMPACT);
  json_decref(message);
  assert_non_null(text);
  for (size_t done = 0, size = strlen(text) + 1; done < size;) {
    ssize_t written = write(d->to, text + done, size - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail_msg("the browser does not listen: %s", strerror(errno));
    done += (size_t)written;
  }
  free(text);
}

static void read_more(devtools *d, int milliseconds) {
  struct pollfd poll_from = {d->from, POLLIN, 0};
  if (poll(&poll_from, 1, milliseconds) <= 0) fail_msg("the browser does not answer");
  if (d->room - d->size < 65536) {
    d->room = 2 * d->room + 131072;
    d->input = realloc(d->input, d->room);
    assert_non_null(d->input);
  }
  ssize_t count = read(d->from, d->input + d->size, d->room - d->size);
  if (count <= 0) fail_msg("the browser has ended");
  d->size += (size_t)count;
}

// The next message, an answer or an event.
static json_t *receive(devtools *d) {
  const char *end;
  while (!(end = d->size ? memchr(d->input, '\0', d->size) : NULL))
    read_more(d, ANSWER_MILLISECONDS);
  json_t *message = json_loads(d->input, 0, NULL);
  size_t used = (size_t)(end - d->input) + 1;
  memmove(d->input, d->input + used, d->size - used);
  d->size -= used;
  assert_non_null(message);
  return message;
}

static void complain(devtools *d, const char *kind, const char *text) {
  size_t used = strlen(d->complaints);
  snprintf(d->complaints + used, COMPLAINTS - used, "%s: %.300s\n", kind, text ? text : "?");
}

static const char *text_at(const json_t *object, const char *outer, const char *inner) {
  return json_string_value(json_object_get(json_object_get(object, outer), inner));
}

static void note_console(devtools *d, const json_t *parameters) {
  const char *type = json_string_value(json_object_get(parameters, "type"));
  const json_t *first = json_array_get(json_object_get(parameters, "args"), 0);
  if (type && (strcmp(type, "error") == 0 || strcmp(type, "warning") == 0))
    complain(d, "console", json_string_value(json_object_get(first, "value")));
}

static void note_event(devtools *d, const json_t *message) {
  const char *method = json_string_value(json_object_get(message, "method"));
  const json_t *parameters = json_object_get(message, "params");
  if (!method) return;
  if (strcmp(method, "Runtime.exceptionThrown") == 0) {
    char *text = json_dumps(json_object_get(parameters, "exceptionDetails"), JSON_COMPACT);
    complain(d, "exception", text);
    free(text);
  } else if (strcmp(method, "Log.entryAdded") == 0) {
    complain(d, "log", text_at(parameters, "entry", "text"));
  } else if (strcmp(method, "Runtime.consoleAPICalled") == 0) {
    note_console(d, parameters);
  } else if (strcmp(method, "Network.requestWillBeSent") == 0) {
    const char *url = text_at(parameters, "request", "url");
    if (!url || !d->address || strncmp(url, d->address, strlen(url)) != 0)
      complain(d, "request", url);
  }
}

// Calls a method of the browser, or of the open tab; the answer's result.
static json_t *call_in(devtools *d, const char *session, const char *method, json_t *parameters) {
  json_t *message = json_pack("{s:i, s:s, s:o}", "id", ++d->last_id, "method", method, "params",
                              parameters ? parameters : json_object());
  assert_non_null(message);
  if (session) json_object_set_new(message, "sessionId", json_string(session));
  send_message(d, message);
  for (;;) {
    json_t *answer = receive(d);
    if (json_integer_value(json_object_get(answer, "id")) != d->last_id) {
      note_event(d, answer);
      json_decref(answer);
      continue;
    }
    const char *error = text_at(answer, "error", "message");
    if (error) fail_msg("%s: %s", method, error);
    json_t *result = json_incref(json_object_get(answer, "result"));
    json_decref(answer);
    return result;
  }
}

static json_t *call(devtools *d, const char *method, json_t *parameters) {
  return call_in(d, d->session, method, parameters);
}

static void order(devtools *d, const char *method, json_t *parameters) {
  json_decref(call(d, method, parameters));
}

static void open_tab(devtools *d) {
  json_t *tab = call_in(d, NULL, "Target.createTarget", json_pack("{s:s}", "url", "about:blank"));
  json_t *attached =
      call_in(d, NULL, "Target.attachToTarget",
              json_pack("{s:O, s:b}", "targetId", json_object_get(tab, "targetId"), "flatten", 1));
  free(d->session);
  d->session = strdup(json_string_value(json_object_get(attached, "sessionId")));
  json_decref(tab);
  json_decref(attached);
}

void devtools_open(devtools *d, const char *address, const devtools_view *view) {
  static const char *const domains[] = {"Page.enable", "Runtime.enable", "Log.enable",
                                        "Network.enable"};
  open_tab(d);
  for (int i = 0; i < 4; i++) order(d, domains[i], NULL);
  order(d, "Emulation.setDeviceMetricsOverride",
        json_pack("{s:i, s:i, s:i, s:b}", "width", view->width, "height", view->height,
                  "deviceScaleFactor", 1, "mobile", 0));
  order(d, "Emulation.setEmulatedMedia",
        json_pack("{s:[{s:s, s:s}]}", "features", "name", "prefers-color-scheme", "value",
                  view->dark ? "dark" : "light"));
  order(d, "Emulation.setScriptExecutionDisabled", json_pack("{s:b}", "value", !view->scripts));
  d->complaints[0] = '\0';
  d->address = address;
  order(d, "Page.navigate", json_pack("{s:s}", "url", address));
  devtools_wait(d, "document.readyState === 'complete' && location.protocol === 'file:'");
}

json_t *devtools_evaluate(devtools *d, const char *expression) {
  json_t *result = call(d, "Runtime.evaluate",
                        json_pack("{s:s, s:b, s:b}", "expression", expression, "awaitPromise", 1,
                                  "returnByValue", 1));
  json_t *thrown = json_object_get(result, "exceptionDetails");
  if (thrown) {
    char *text = json_dumps(thrown, JSON_COMPACT);
    fail_msg("%s: %s", expression, text);
  }
  json_t *value = json_incref(json_object_get(json_object_get(result, "result"), "value"));
  json_decref(result);
  return value;
}

bool devtools_true(devtools *d, const char *expression) {
  json_t *value = devtools_evaluate(d, expression);
  bool truth = json_is_true(value);
  json_decref(value);
  return truth;
}

double devtools_number(devtools *d, const char *expression) {
  json_t *value = devtools_evaluate(d, expression);
  if (!json_is_number(value)) fail_msg("%s: is not a number", expression);
  double number = json_number_value(value);
  json_decref(value);
  return number;
}

void devtools_wait(devtools *d, const char *expression) {
  for (int spent = 0; !devtools_true(d, expression); spent += 50) {
    if (spent >= WAIT_MILLISECONDS) fail_msg("in vain: %s\n%s", expression, d->complaints);
    nanosleep(&(struct timespec){.tv_nsec = 50000000}, NULL);
  }
}

static void mouse(devtools *d, const char *type, double x, double y, bool pressed) {
  order(d, "Input.dispatchMouseEvent",
        json_pack("{s:s, s:f, s:f, s:s, s:i}", "type", type, "x", x, "y", y, "button",
                  pressed ? "left" : "none", "clickCount", pressed ? 1 : 0));
}

void devtools_point(devtools *d, const char *selector, double share, bool click) {
  char *expression = NULL;
  assert_true(asprintf(&expression,
                       "(() => { const e = document.querySelector(\"%s\"); "
                       "e.scrollIntoView({block: 'center'}); const r = e.getBoundingClientRect(); "
                       "return [r.left + %.17g * r.width, r.top + r.height / 2]; })()",
                       selector, share) > 0);
  json_t *place = devtools_evaluate(d, expression);
  double x = json_number_value(json_array_get(place, 0));
  double y = json_number_value(json_array_get(place, 1));
  mouse(d, "mouseMoved", x, y, false);
  if (click) {
    mouse(d, "mousePressed", x, y, true);
    mouse(d, "mouseReleased", x, y, true);
  }
  json_decref(place);
  free(expression);
}

static int base64_value(char c) {
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const char *at = c ? strchr(digits, c) : NULL;
  return at ? (int)(at - digits) : -1;
}

static void write_decoded(FILE *stream, const char *text) {
  unsigned group = 0;
  int bits = 0;
  for (; *text && base64_value(*text) >= 0; text++) {
    group = group << 6 | (unsigned)base64_value(*text);
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    fputc((int)(group >> bits & 255), stream);
  }
}

void devtools_picture(devtools *d, const char *path) {
  json_t *result = call(d, "Page.captureScreenshot",
                        json_pack("{s:s, s:b}", "format", "png", "captureBeyondViewport", 1));
  FILE *stream = fopen(path, "wbe");
  assert_non_null(stream);
  write_decoded(stream, json_string_value(json_object_get(result, "data")));
  assert_int_equal(fclose(stream), 0);
  json_decref(result);
}

const char *devtools_complaints(devtools *d) {
  return d->complaints;
}
