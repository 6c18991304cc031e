// SPDX-License-Identifier: Apache-2.0
#ifndef BICYCLE_EXPORT_H
#define BICYCLE_EXPORT_H

// The library is compiled with hidden symbols; what carries this mark is its interface.
#ifdef __cplusplus
#define BIKE_API extern "C" __attribute__((visibility("default")))
#else
#define BIKE_API __attribute__((visibility("default")))
#endif

#endif
