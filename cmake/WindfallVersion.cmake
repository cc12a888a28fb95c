# Writes the header with the program's version. Run by `cmake -P` at every build, so that a new commit shows
# without configuring again; the file is only touched when the version has changed.
#   cmake -DSOURCE_DIR=... -DVERSION=0.1.0 -DTEMPLATE=... -DOUTPUT=... -P WindfallVersion.cmake
set(WINDFALL_PROGRAM_VERSION "${VERSION}")

# Only this tree's own repository counts: unpacked from an archive it may lie inside another one.
find_program(GIT git)
if(GIT AND EXISTS "${SOURCE_DIR}/.git")
  execute_process(COMMAND "${GIT}" rev-parse --short=7 HEAD WORKING_DIRECTORY "${SOURCE_DIR}"
                  RESULT_VARIABLE failed OUTPUT_VARIABLE commit ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(NOT failed)
    execute_process(COMMAND "${GIT}" --no-optional-locks status --porcelain --untracked-files=no
                    WORKING_DIRECTORY "${SOURCE_DIR}" OUTPUT_VARIABLE changes ERROR_QUIET)
    string(APPEND WINDFALL_PROGRAM_VERSION "+${commit}")
    if(changes)
      string(APPEND WINDFALL_PROGRAM_VERSION "-dirty")
    endif()
  endif()
endif()

configure_file("${TEMPLATE}" "${OUTPUT}" @ONLY)
