# Compiles through ccache where it is installed: a second build of the same sources, also in another checkout, then takes seconds.
find_program(FAINTLINE_CCACHE ccache)
if(FAINTLINE_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
        CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1 # paths do not count
        CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime # precompiled headers do
        ${FAINTLINE_CCACHE})
endif()
