# Where freestand reproduce finds the report's printed tables, unless it is told.
set_property(SOURCE ${CMAKE_SOURCE_DIR}/src/study/reproduce.cpp APPEND PROPERTY COMPILE_DEFINITIONS
             FREESTAND_REPORT_TABLES="${CMAKE_SOURCE_DIR}/configs/report")
