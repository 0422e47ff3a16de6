# How rooms and tests are built: one small function each.

# Flags of every file. The baseline is AVX2 with FMA; kernels are compiled once more for AVX-512.
add_library(gannet_flags INTERFACE)
target_compile_options(gannet_flags INTERFACE
  -march=x86-64-v3 -fno-math-errno -fno-trapping-math
  -Wall -Wextra -Wpedantic -Wshadow -Werror
  # Designated initialisers name what they set; what they leave out has its default.
  -Wno-missing-field-initializers)
target_include_directories(gannet_flags INTERFACE ${PROJECT_SOURCE_DIR}/src
                                                  ${PROJECT_SOURCE_DIR}/include)
# What is looked at is the solver: the tests around it only have to compile fast.
add_library(gannet_sanitizers INTERFACE)
if(GANNET_SANITIZE)
  # Left out: what the address sanitizer or the processor notices anyway. They are a fifth of the
  # time to compile.
  target_compile_options(gannet_sanitizers INTERFACE -fsanitize=address,undefined
                         -fno-sanitize=null,alignment,object-size,vptr
                         -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(gannet_flags INTERFACE -fsanitize=address,undefined)
endif()

# Headers that nearly every file reads, parsed once: Eigen alone takes three of the four seconds of a
# small file. Kernels (*.isa.cpp) do without, for they may not include them.
add_library(gannet_common STATIC ${PROJECT_SOURCE_DIR}/cmake/common.cpp)
target_link_libraries(gannet_common PUBLIC gannet_flags Eigen3::Eigen TBB::tbb fmt::fmt
                                    PRIVATE gannet_sanitizers)
target_precompile_headers(gannet_common PRIVATE
  <Eigen/Core> <Eigen/Eigenvalues> <Eigen/Geometry> <fmt/format.h> <algorithm> <array> <cmath>
  <cstdint> <deque> <functional> <limits> <map> <memory> <string> <vector>)

# gannet_room(NAME SOURCES a.cpp ... [ISA c.isa.cpp ...] [USES other rooms and libraries ...])
# makes the library gannet_NAME. Sources are compiled eight at a time, for what they share takes longer
# to compile than they do; two that meet may not give one name to what is their own, so that effects,
# which all have a schema, a state and operations, keep theirs in a namespace each. Files under ISA are
# compiled once per instruction set.
function(gannet_room NAME)
  cmake_parse_arguments(ROOM "" "" "SOURCES;ISA;USES" ${ARGN})
  set(target gannet_${NAME})
  add_library(${target} STATIC ${ROOM_SOURCES})
  target_link_libraries(${target} PUBLIC gannet_common ${ROOM_USES} PRIVATE gannet_sanitizers)
  target_precompile_headers(${target} REUSE_FROM gannet_common)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
  # Taken together they look like headers, whose types may not be a file's own.
  target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
  foreach(set avx2 avx512)
    if(ROOM_ISA)
      set(objects ${target}_${set})
      add_library(${objects} OBJECT ${ROOM_ISA})
      target_link_libraries(${objects} PRIVATE gannet_flags)
      if(set STREQUAL avx2)
        # The same source of kernels is looked at once: its checks take long to compile.
        target_link_libraries(${objects} PRIVATE gannet_sanitizers)
      endif()
      target_compile_definitions(${objects} PRIVATE GANNET_ISA_NS=${set})
      # Terms that a pass does not have leave their values unset; g++ 12 does not see that the flag
      # that reads them is the one that set them.
      target_compile_options(${objects} PRIVATE $<IF:$<BOOL:${GANNET_SANITIZE}>,-O1,-O3>
                             -Wno-maybe-uninitialized)
      if(GANNET_SANITIZE)
        # Instrumented, the two halves of an AVX2 vector may be contracted to fused multiply-adds
        # differently, so that the bits of an element would depend on the lane it is in.
        target_compile_options(${objects} PRIVATE -ffp-contract=off)
      endif()
      # Structures of vectors are copied a register at a time: by halves, what reads them whole waits
      # until the halves have arrived in memory. (clang does so by itself.)
      if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 12)
        set(register $<IF:$<STREQUAL:${set},avx512>,512,256>)
        target_compile_options(${objects} PRIVATE -mmove-max=${register} -mstore-max=${register})
      endif()
      if(set STREQUAL avx512)
        # g++ 12 warns of its own intrinsics (their "undefined" operand) once they are inlined.
        target_compile_options(${objects} PRIVATE -mavx512f -mavx512dq -mavx512vl -mavx512bw
                               -mprefer-vector-width=512 -Wno-uninitialized)
      endif()
      target_sources(${target} PRIVATE $<TARGET_OBJECTS:${objects}>)
    endif()
  endforeach()
endfunction()

# gannet_test_program(NAME SOURCES a.cpp ... [USES libraries ...]) makes the executable test_NAME with
# Catch2's main. Eight files at a time: what they share takes longer to compile than they do.
function(gannet_test_program NAME)
  cmake_parse_arguments(T "" "" "SOURCES;USES" ${ARGN})
  add_executable(test_${NAME} ${T_SOURCES})
  target_precompile_headers(test_${NAME} REUSE_FROM gannet_test_main)
  set_target_properties(test_${NAME} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8
    UNITY_BUILD_CODE_BEFORE_INCLUDE "#pragma GCC diagnostic ignored \"-Wshadow\"")
  target_include_directories(test_${NAME} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_link_libraries(test_${NAME} PRIVATE gannet_test_main ${T_USES})
endfunction()

# gannet_test_entry(NAME PROGRAM LABEL [arguments ...]) makes the CTest entry NAME of a test program,
# which fails where the arguments choose no test.
function(gannet_test_entry NAME PROGRAM LABEL)
  add_test(NAME ${NAME} COMMAND ${PROGRAM} -d yes -w NoTests ${ARGN} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  set_tests_properties(${NAME} PROPERTIES LABELS "${LABEL}")
endfunction()

# gannet_test(NAME SOURCES a.cpp ... [USES libraries ...] [LABEL fast]) makes both.
function(gannet_test NAME)
  cmake_parse_arguments(T "" "LABEL" "" ${ARGN})
  gannet_test_program(${NAME} ${T_UNPARSED_ARGUMENTS})
  gannet_test_entry(${NAME} test_${NAME} "${T_LABEL}")
endfunction()
