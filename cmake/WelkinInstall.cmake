# Installs the library, its public headers, and what find_package(welkin) and pkg-config need.
#
# src/welkin/public_headers.txt names the headers; tests/install_test.sh compiles all of them.
include(CMakePackageConfigHelpers)

set(libraries welkin)
foreach(other welkin_static welkin_shared)
  if(TARGET ${other} AND WELKIN_BUILD_BOTH)
    string(REPLACE "welkin_" "" kind ${other})
    set_target_properties(${other} PROPERTIES EXPORT_NAME ${kind})
    list(APPEND libraries ${other})
  endif()
endforeach()
install(TARGETS ${libraries} EXPORT welkin-targets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
        RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})

set(header_list ${PROJECT_SOURCE_DIR}/src/welkin/public_headers.txt)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${header_list})
file(STRINGS ${header_list} public_headers REGEX "^[a-z]")
foreach(header IN LISTS public_headers)
  cmake_path(GET header PARENT_PATH room)
  install(FILES ${PROJECT_SOURCE_DIR}/src/welkin/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/welkin/${room})
endforeach()

# find_package(welkin)
set(package_destination ${CMAKE_INSTALL_LIBDIR}/cmake/welkin)
get_target_property(library_type welkin TYPE)
if(library_type STREQUAL "STATIC_LIBRARY" OR WELKIN_BUILD_BOTH)
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
set(link_only tbb OpenEXR Imath libpng libjpeg libtiff-4 libwebp libwebpdemux libwebpmux libdeflate libzstd lcms2 pugixml zlib)
list(JOIN link_only " " link_only)
set(link_by_name "")
foreach(name IN LISTS CMAKE_DL_LIBS)
  string(APPEND link_by_name "-l${name} ")
endforeach()
string(APPEND link_by_name "-pthread")
set(pc_requires "")
set(pc_libs "-L\${libdir} -lwelkin")
set(pc_libs_private "")
if(WELKIN_IS_STATIC)
  set(pc_requires "${link_only}")
  set(pc_requires_private "")
  string(APPEND pc_libs " ${link_by_name}")
else()
  set(pc_requires_private "${link_only}")
  set(pc_libs_private "${link_by_name}")
endif()
cmake_path(RELATIVE_PATH CMAKE_INSTALL_FULL_LIBDIR BASE_DIRECTORY ${CMAKE_INSTALL_PREFIX} OUTPUT_VARIABLE pc_libdir)
cmake_path(RELATIVE_PATH CMAKE_INSTALL_FULL_INCLUDEDIR BASE_DIRECTORY ${CMAKE_INSTALL_PREFIX} OUTPUT_VARIABLE pc_includedir)
# From the file's own place, so that the installed tree can be moved, and `cmake --install --prefix` works.
cmake_path(RELATIVE_PATH CMAKE_INSTALL_PREFIX BASE_DIRECTORY ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig OUTPUT_VARIABLE pc_prefix)
configure_file(${CMAKE_CURRENT_LIST_DIR}/welkin.pc.in ${PROJECT_BINARY_DIR}/welkin.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/welkin.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
