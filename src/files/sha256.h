// SPDX-License-Identifier: Apache-2.0
// SHA-256 (FIPS 180-4), so that a report can say which model it is about and `sha256sum` can check.
#ifndef FILES_SHA256_H
#define FILES_SHA256_H

#include <stddef.h>

enum { SHA256_HEX_SIZE = 65 };

// 64 lower-case hexadecimal digits and a terminator.
void sha256_hex(char out[SHA256_HEX_SIZE], const void *data, size_t size);

#endif
