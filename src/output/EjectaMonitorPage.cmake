# Compiles the monitor page into the library, so that the binary needs no files beside it.
set(page ${PROJECT_SOURCE_DIR}/src/output/monitor_page.html)
file(READ ${page} EJECTA_MONITOR_PAGE)
configure_file(${PROJECT_SOURCE_DIR}/src/output/monitor_page.cpp.in ${PROJECT_BINARY_DIR}/monitor_page.cpp @ONLY)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${page})
target_sources(ejecta_output PRIVATE ${PROJECT_BINARY_DIR}/monitor_page.cpp)
