// SPDX-License-Identifier: Apache-2.0
// A stream into memory.
#ifndef BICYCLE_FILES_MEMORY_STREAM_H
#define BICYCLE_FILES_MEMORY_STREAM_H

#include <stddef.h>
#include <stdio.h>

// Like open_memstream, but for a want of memory while something is written: ferror then says so,
// and fclose fails. (glibc's own loses the bytes without a word.) *text is to be freed in any case,
// and up to date, a NUL at its end, after fflush and fclose. NULL: out of memory, nothing to free.
FILE *bike_memory_stream(char **text, size_t *size);

#endif
