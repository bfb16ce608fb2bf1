#pragma once

#include "welkin/base/export.h"

/// WELKIN_API marks what a shared library shows to its users; all else is hidden (src/welkin/CMakeLists.txt).
#if defined(__GNUC__)
#define WELKIN_API __attribute__((visibility("default")))
#else
#define WELKIN_API
#endif
