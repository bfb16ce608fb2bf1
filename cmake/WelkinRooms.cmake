# A room is a folder of src/welkin: one object library, its tests beside its code.
#
#   welkin_room(NAME SOURCES … LINK libraries… TESTS …)
#
# src/welkin/rooms.txt has the rooms' order, and which rooms each uses; tests/rooms_test.sh holds the includes to it.

# welkin_read_rooms(FILE): sets WELKIN_ROOM_NAMES, and WELKIN_USES_<room> for each.
macro(welkin_read_rooms file)
  file(STRINGS ${file} lines REGEX "^[a-z_]+:")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  set(WELKIN_ROOM_NAMES)
  foreach(line IN LISTS lines)
    string(REGEX MATCH "^[a-z_]+" room "${line}")
    string(REGEX REPLACE "^[a-z_]+: *" "" uses "${line}")
    string(REPLACE " " ";" WELKIN_USES_${room} "${uses}")
    list(APPEND WELKIN_ROOM_NAMES ${room})
  endforeach()
endmacro()

function(welkin_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wconversion)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # GCC 12 warns falsely of "literal" + std::string (GCC bug 105329).
    target_compile_options(${target} PRIVATE -Wno-restrict)
  endif()
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND WELKIN_PRECOMPILE)
    # It forgets that precompiled headers are the system's, and doubts their std::string, falsely.
    target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
  endif()
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_FLAGS MATCHES "-fsanitize")
    # The sanitizers' instrumentation makes GCC doubt variables of xsimd that are always set.
    target_compile_options(${target} PRIVATE -Wno-maybe-uninitialized)
  endif()
  if(WELKIN_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()

# Tests are compiled faster than they could run: half of a release build would be optimising their assertions.
function(welkin_test_options target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

function(welkin_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;LINK;TESTS" ${ARGN})
  add_library(welkin_${name} OBJECT ${ROOM_SOURCES})
  target_compile_features(welkin_${name} PUBLIC cxx_std_20)
  set_target_properties(welkin_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden
                                                   VISIBILITY_INLINES_HIDDEN ON)
  target_include_directories(welkin_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>)
  foreach(room IN LISTS WELKIN_USES_${name})
    target_link_libraries(welkin_${name} PUBLIC welkin_${room})
  endforeach()
  target_link_libraries(welkin_${name} PRIVATE ${ROOM_LINK})
  welkin_warnings(welkin_${name})
  welkin_precompiled(welkin_${name} welkin_room_headers)
  set_property(GLOBAL APPEND PROPERTY WELKIN_ROOMS ${name})
  set_property(GLOBAL APPEND PROPERTY WELKIN_TEST_SOURCES ${ROOM_TESTS})
  if(WELKIN_BUILD_TESTS AND ROOM_TESTS)
    add_executable(welkin_${name}_test ${ROOM_TESTS})
    target_link_libraries(welkin_${name}_test PRIVATE welkin_internals ${ROOM_LINK} GTest::gtest_main)
    welkin_warnings(welkin_${name}_test)
    welkin_test_options(welkin_${name}_test)
    welkin_precompiled(welkin_${name}_test welkin_test_headers)
    gtest_discover_tests(welkin_${name}_test DISCOVERY_TIMEOUT 60)
  endif()
endfunction()
