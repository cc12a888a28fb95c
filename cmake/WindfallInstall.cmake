# cmake --install: the program, its presets where it looks for them (share/windfall beside bin), its papers.
install(TARGETS windfall RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/presets/" DESTINATION "${CMAKE_INSTALL_DATADIR}/windfall/presets"
        FILES_MATCHING PATTERN "*.toml" PATTERN "*.obj")
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" "${PROJECT_SOURCE_DIR}/README.md"
        DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/windfall")
