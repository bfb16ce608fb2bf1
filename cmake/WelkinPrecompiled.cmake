# The standard library's headers, read once for all rooms and once for all tests: reading them is half the time of a build from nothing.
# Every file still includes what it uses: the presets `clang` and `dev` build without (WELKIN_PRECOMPILE=OFF).

option(WELKIN_PRECOMPILE "Precompile the standard library's headers" ${PROJECT_IS_TOP_LEVEL})

set(WELKIN_STANDARD_HEADERS
    <algorithm> <array> <atomic> <bit> <cassert> <charconv> <chrono> <cmath> <concepts> <cstddef> <cstdint> <cstdio> <cstdlib>
    <cstring> <exception> <filesystem> <fstream> <functional> <iterator> <limits> <map> <memory> <mutex> <numbers> <numeric>
    <optional> <random> <set> <span> <sstream> <stdexcept> <string> <string_view> <system_error> <thread> <tuple> <type_traits>
    <utility> <variant> <vector>)

# welkin_precompiled_headers(NAME HEADERS…): makes the target that others take their headers from.
function(welkin_precompiled_headers name)
  if(NOT WELKIN_PRECOMPILE)
    return()
  endif()
  set(file ${PROJECT_BINARY_DIR}/${name}.cpp)
  file(CONFIGURE OUTPUT ${file} CONTENT "// Nothing: the target exists for its precompiled headers.\n")
  add_library(${name} OBJECT ${file})
  target_compile_features(${name} PUBLIC cxx_std_20)
  welkin_warnings(${name})
  target_precompile_headers(${name} PRIVATE ${ARGN})
endfunction()

# welkin_precompiled(TARGET FROM): TARGET, whose options are those of FROM, reads FROM's headers.
function(welkin_precompiled target from)
  if(WELKIN_PRECOMPILE)
    target_precompile_headers(${target} REUSE_FROM ${from})
  endif()
endfunction()
