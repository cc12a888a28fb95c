# How every target is compiled. Contraction of a*b+c is stated (fast: GCC fuses where the ISA has FMA) and
# -ffast-math is never used, so that results are the same bits for any thread count on one machine.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

option(WINDFALL_WARNINGS_AS_ERRORS "Treat warnings as errors" ON)
set(WINDFALL_SANITIZE "" CACHE STRING "Sanitizers, as for -fsanitize (address,undefined)")

# For every target alike: Eigen's types are laid out by the instruction set, and must be the same everywhere.
add_compile_options(-march=x86-64-v3 -ffp-contract=fast)

find_program(WINDFALL_CCACHE ccache)
if(WINDFALL_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${WINDFALL_CCACHE}")
endif()

# windfall_library(NAME SOURCES ... LINKS ...): a floor of the house, a static library with include root src/.
function(windfall_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_include_directories(${name} PUBLIC "${PROJECT_SOURCE_DIR}/src")
  target_link_libraries(${name} PUBLIC ${ARG_LINKS})
  windfall_compile_options(${name})
endfunction()

# Lower optimisation than the build type's -O3, for what has no hot loops: it halves the time to compile.
function(windfall_optimise name level)
  if(CMAKE_BUILD_TYPE STREQUAL "Release")
    target_compile_options(${name} PRIVATE ${level})
  endif()
endfunction()

# Sources with hot loops, compiled one by one: in a batch the compiler inlines less and gives up on vector code,
# and they take two to four times as long. The flags change no result: they say that nobody reads errno or the
# floating-point flags, so that square roots and comparisons can become vector code.
function(windfall_hot)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  if(NOT WINDFALL_SANITIZE)
    set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "-O3;-fno-math-errno;-fno-trapping-math")
  endif()
endfunction()

function(windfall_compile_options name)
  target_compile_options(${name} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wno-psabi)
  # GCC 12 sees overlaps in "text" + string that are not there, in some batches (its bug 105329).
  target_compile_options(${name} PRIVATE -Wno-restrict)
  if(WINDFALL_WARNINGS_AS_ERRORS)
    target_compile_options(${name} PRIVATE -Werror)
  endif()
  if(WINDFALL_SANITIZE)
    target_compile_options(${name} PUBLIC -fsanitize=${WINDFALL_SANITIZE} -fno-omit-frame-pointer
                                          -fno-sanitize-recover=all)
    # What the processor traps by itself, or address finds anyway; a third of the time to compile.
    target_compile_options(${name} PUBLIC -fno-sanitize=null,alignment,vptr)
    target_link_options(${name} PUBLIC -fsanitize=${WINDFALL_SANITIZE})
  endif()
endfunction()
