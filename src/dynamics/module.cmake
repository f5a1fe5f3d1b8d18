# The kernels of whole blocks, once per instruction set. A portable build (x86-64-v2) holds those of
# FREESTAND_LEVELS and picks at run time.
function(freestand_kernels ISA)
  add_library(freestand_kernels_${ISA} OBJECT ${CMAKE_SOURCE_DIR}/src/dynamics/pack/kernels.cpp
              ${CMAKE_SOURCE_DIR}/src/dynamics/pack/pulled_kernels.cpp
              ${CMAKE_SOURCE_DIR}/src/dynamics/pack/shaken_kernels.cpp
              ${CMAKE_SOURCE_DIR}/src/dynamics/pack/law_kernels.cpp
              ${CMAKE_SOURCE_DIR}/src/dynamics/pack/plane_kernels.cpp
              ${CMAKE_SOURCE_DIR}/src/dynamics/pack/pulse_kernels.cpp)
  target_include_directories(freestand_kernels_${ISA} PRIVATE ${CMAKE_SOURCE_DIR}/src ${CMAKE_SOURCE_DIR}/include)
  target_compile_definitions(freestand_kernels_${ISA} PRIVATE FREESTAND_ISA=${ISA} FREESTAND_ISA_NAME="${ISA}")
  target_compile_options(freestand_kernels_${ISA} PRIVATE ${ARGN})
  target_sources(freestand_dynamics PRIVATE $<TARGET_OBJECTS:freestand_kernels_${ISA}>)
endfunction()

# The AVX-512 headers of g++ 12 read variables that they left without a value on purpose, and g++ warns of it where they
# are inlined (GCC bug 105593). The same text is compiled without AVX-512 with these warnings on.
set(freestand_avx512_headers -Wno-uninitialized -Wno-maybe-uninitialized)

# Those that are compiled, the widest last, for dynamics/batch.cpp.
if(FREESTAND_ARCH STREQUAL "x86-64-v2")
  set(freestand_flags_v3 -march=x86-64-v3)
  set(freestand_flags_v4 -march=x86-64-v4 ${freestand_avx512_headers})
  set(freestand_levels ${FREESTAND_LEVELS})
  if(NOT freestand_levels MATCHES "^v2(;v3)?(;v4)?$")
    message(FATAL_ERROR "FREESTAND_LEVELS is \"${FREESTAND_LEVELS}\": v2, and of v3 and v4 those that are wanted, in this order")
  endif()
else()
  set(freestand_flags_own ${freestand_avx512_headers})
  set(freestand_levels own)
endif()
set(freestand_level_list "")
foreach(level ${freestand_levels})
  freestand_kernels(${level} ${freestand_flags_${level}})
  string(APPEND freestand_level_list "FREESTAND_KERNELS(${level})\n")
endforeach()
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/generated/kernel_levels.inc CONTENT "${freestand_level_list}")
target_include_directories(freestand_dynamics PRIVATE ${CMAKE_BINARY_DIR}/generated)
