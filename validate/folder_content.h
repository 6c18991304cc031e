// SPDX-License-Identifier: Apache-2.0
// What stands in a report's folder, so that nothing else is ever removed.
#ifndef VALIDATE_FOLDER_CONTENT_H
#define VALIDATE_FOLDER_CONTENT_H

#include "problem.h"

// TERM_DONE for an empty folder or a report whose report.json lists every file that is there.
term_exit folder_content_check(const char *path, problem *p);

// Removes a folder and the plain files in it, if it exists.
void folder_content_remove(const char *path);

#endif
