#pragma once

/// @file
/// The macro that exports.

/// Marks what a shared library shows to its users; all else is hidden (src/welkin/CMakeLists.txt).
#if defined(__GNUC__)
#define WELKIN_API __attribute__((visibility("default")))
#else
#define WELKIN_API
#endif
