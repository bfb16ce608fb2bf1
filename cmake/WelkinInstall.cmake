# Installs the library, its public headers, and what find_package(welkin) and pkg-config need.
#
# Public headers: every header of the rooms, save those that only their own room or its tests include:
# kernels that need SIMD libraries (*_impl.h), what several source files share (*_job.h), cases for tests, the inside of the file
# formats and of the built-in maps.
# tests/install_test.sh compiles all that are installed.
include(CMakePackageConfigHelpers)

install(TARGETS welkin EXPORT welkin-targets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
        RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})

set(include_destination ${CMAKE_INSTALL_INCLUDEDIR}/welkin)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/welkin/ DESTINATION ${include_destination}
        FILES_MATCHING PATTERN "*.h"
        PATTERN "*_impl.h" EXCLUDE
        PATTERN "*_cases.h" EXCLUDE
        PATTERN "*_job.h" EXCLUDE
        PATTERN "*test*" EXCLUDE
        REGEX "/src/welkin/(io|synth|image)$" EXCLUDE
        REGEX "/lobe/(all|angle|blinn|charlie|ggx|kernels|lambert|panels|phong|table|table_file|table_points|von_mises_fisher)\\.h$" EXCLUDE
        REGEX "/prefilter/(bright_points|buffer|fft|harmonics|kernels|lagrange|lanes|legendre|level_texels|near|near_field|plan|point_grid|sampled_lobe|spline_grid|spreading|widen)\\.h$" EXCLUDE)
install(FILES ${PROJECT_SOURCE_DIR}/src/welkin/io/image_file.h DESTINATION ${include_destination}/io)
install(FILES ${PROJECT_SOURCE_DIR}/src/welkin/synth/synth.h ${PROJECT_SOURCE_DIR}/src/welkin/synth/render_synth.h DESTINATION ${include_destination}/synth)
install(FILES ${PROJECT_SOURCE_DIR}/src/welkin/image/image.h DESTINATION ${include_destination}/image)

# find_package(welkin)
set(package_destination ${CMAKE_INSTALL_LIBDIR}/cmake/welkin)
get_target_property(library_type welkin TYPE)
if(library_type STREQUAL "STATIC_LIBRARY")
  set(WELKIN_IS_STATIC ON)
else()
  set(WELKIN_IS_STATIC OFF)
endif()
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/welkin-config.cmake.in ${PROJECT_BINARY_DIR}/welkin-config.cmake
                              INSTALL_DESTINATION ${package_destination})
# Before version 1, a minor version may break what an older one promised.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/welkin-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/welkin-config.cmake ${PROJECT_BINARY_DIR}/welkin-config-version.cmake
        DESTINATION ${package_destination})
install(EXPORT welkin-targets NAMESPACE welkin:: DESTINATION ${package_destination})

# pkg-config. A static library makes its user link what it uses, so `pkg-config --libs` names it without `--static` too.
set(link_only OpenEXR Imath libpng libjpeg libtiff-4 libwebp libdeflate libzstd zlib)
list(JOIN link_only " " link_only)
set(pc_requires "tbb")
set(pc_libs "-L\${libdir} -lwelkin")
set(pc_libs_private "")
if(WELKIN_IS_STATIC)
  string(APPEND pc_requires " ${link_only}")
  set(pc_requires_private "")
  string(APPEND pc_libs " -pthread")
else()
  set(pc_requires_private "${link_only}")
  set(pc_libs_private "-pthread")
endif()
cmake_path(RELATIVE_PATH CMAKE_INSTALL_FULL_LIBDIR BASE_DIRECTORY ${CMAKE_INSTALL_PREFIX} OUTPUT_VARIABLE pc_libdir)
cmake_path(RELATIVE_PATH CMAKE_INSTALL_FULL_INCLUDEDIR BASE_DIRECTORY ${CMAKE_INSTALL_PREFIX} OUTPUT_VARIABLE pc_includedir)
# From the file's own place, so that the installed tree can be moved, and `cmake --install --prefix` works.
cmake_path(RELATIVE_PATH CMAKE_INSTALL_PREFIX BASE_DIRECTORY ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig OUTPUT_VARIABLE pc_prefix)
configure_file(${CMAKE_CURRENT_LIST_DIR}/welkin.pc.in ${PROJECT_BINARY_DIR}/welkin.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/welkin.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
