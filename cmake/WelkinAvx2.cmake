# welkin_avx2_sources(ROOM FILES…): compiles these files for AVX2 + FMA on x86-64; they are called only where the
# processor has both (base/cpu.h). Elsewhere they are left out.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set(WELKIN_HAS_AVX2 ON)
  add_compile_definitions(WELKIN_HAS_AVX2)
endif()

function(welkin_avx2_sources room)
  if(WELKIN_HAS_AVX2)
    target_sources(welkin_${room} PRIVATE ${ARGN})
    set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "-mavx2;-mfma;-Dxsimd=xsimd_avx2")
  endif()
endfunction()
