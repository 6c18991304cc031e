// SPDX-License-Identifier: Apache-2.0
// The place of a folder that appears whole or not at all: it is filled under another name beside
// its place and takes that by a rename. What may be replaced is for the caller to say.
#ifndef BICYCLE_TERMINAL_FOLDER_PLACE_H
#define BICYCLE_TERMINAL_FOLDER_PLACE_H

// The path without slashes at its end, symbolic links followed. NULL without memory; to be freed.
char *term_place_of(const char *path);

// "PARENT/.NAME.PID.KIND" beside such a path. NULL without memory; to be freed.
char *term_place_aside(const char *place, const char *kind);

// The folder that such a path stands in. NULL without memory; to be freed.
char *term_place_parent(const char *place);

// 0 if the folder takes new entries, errno if not.
int term_place_check_parent(const char *parent);

// Removes a folder and those files in it that are the caller's.
typedef void term_place_remove(const char *folder, const void *user);

// Gives the folder `aside` the name and place of `place`, in the stead of the folder that is there;
// that one is removed. 0, or errno: then both are as before.
int term_place_take(const char *aside, const char *place, term_place_remove *remove,
                    const void *user);

#endif
