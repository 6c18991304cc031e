// SPDX-License-Identifier: Apache-2.0
// The files of web/ and Debian's dygraphs, embedded when the program is built.
#ifndef VALIDATE_REPORT_WEB_H
#define VALIDATE_REPORT_WEB_H

extern const char report_web_style[];    // page.css
extern const char report_web_dygraphs[]; // dygraph.min.js with its licence line
extern const char report_web_script[];   // all scripts of web/, joined

#endif
