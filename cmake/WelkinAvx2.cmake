# welkin_avx2_sources(ROOM FILES…): compiles these files for AVX2 + FMA on x86-64, as a target welkin_ROOM_avx2; they are called only
# where the processor has both (base/cpu.h). Elsewhere they are left out.
#
# What such a file leaves to the linker must not be taken by baseline code: xsimd is renamed in it, so that every inline function
# of xsimd differs in name, and tests/kernels_test.sh looks for others (docs/decisions).
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set(WELKIN_HAS_AVX2 ON)
  add_compile_definitions(WELKIN_HAS_AVX2)
endif()

function(welkin_avx2_sources room)
  if(WELKIN_HAS_AVX2)
    add_library(welkin_${room}_avx2 OBJECT ${ARGN})
    set_target_properties(welkin_${room}_avx2 PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden
                                                          VISIBILITY_INLINES_HIDDEN ON)
    target_compile_options(welkin_${room}_avx2 PRIVATE -mavx2 -mfma -Dxsimd=xsimd_avx2)
    target_link_libraries(welkin_${room}_avx2 PRIVATE welkin_${room})
    welkin_warnings(welkin_${room}_avx2)
    set_property(GLOBAL APPEND PROPERTY WELKIN_ROOMS ${room}_avx2)
    set_property(GLOBAL APPEND PROPERTY WELKIN_AVX2_TARGETS welkin_${room}_avx2)
  endif()
endfunction()
