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

function(windfall_compile_options name)
  target_compile_options(${name} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wno-psabi)
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
