# Language, warnings, numerics and sanitizers: the same for every target.
option(FREESTAND_TESTS "build the tests" ON)
option(FREESTAND_BENCHMARKS "build the benchmark of the kernel (needs Google Benchmark and Boost)" OFF)
option(FREESTAND_BATCHES "compile the sources of a target in batches: a third of the work for a whole build" ON)
option(FREESTAND_WERROR "warnings are errors" OFF)
set(FREESTAND_FUZZ "" CACHE PATH "the build folder of a release: what a fuzzer runs is built (needs clang), and what reads no files is taken from there")
set(FREESTAND_SANITIZE "" CACHE STRING "sanitizers, as -fsanitize= takes them")
set(FREESTAND_ARCH "x86-64-v2" CACHE STRING "instruction set, as -march= takes it")
set(FREESTAND_LEVELS "v2;v3;v4" CACHE STRING
    "levels of x86-64 that a portable build has kernels for: the widest that a machine has is taken when the program runs; one has to be v2")
set(FREESTAND_DATA_DIR "${CMAKE_SOURCE_DIR}/../shared/data" CACHE PATH
    "real records and measurements; the tests that need them skip when it is not there")

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

# The same study gives the same bits: no contraction, no reassociation. Fused operations would make rocking and slide-rock
# a tenth faster, but the compiler fuses a formula differently in each place where it stands, so that the answer to a
# sample would depend on the samples beside it.
add_compile_options(-Wall -Wextra -ffp-contract=off)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64" AND FREESTAND_ARCH)
  add_compile_options(-march=${FREESTAND_ARCH})
endif()
if(FREESTAND_WERROR)
  add_compile_options(-Werror)
endif()
if(FREESTAND_SANITIZE)
  add_compile_options(-fsanitize=${FREESTAND_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${FREESTAND_SANITIZE})
endif()
# Once its heap has 128 MB g++ collects its garbage again and again, for a tenth of its time; at a gigabyte is soon enough.
add_compile_options($<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=1048576>)
find_program(FREESTAND_CCACHE ccache)
if(FREESTAND_CCACHE)  # it keeps what precompiled headers went into only where it is told to
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${FREESTAND_CCACHE})
endif()

# freestand_batches(TARGET SIZE): up to SIZE sources of the target are compiled as one, so that the headers that they share
# are read once. Names in their anonymous namespaces must differ. Small files want large batches.
function(freestand_batches TARGET SIZE)
  if(FREESTAND_BATCHES)
    set_target_properties(${TARGET} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${SIZE})
    target_compile_options(${TARGET} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)  # takes each file of a batch for a header
  endif()
endfunction()
