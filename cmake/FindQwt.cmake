# Provides Qwt::Qwt: an installed Qwt built for Qt 6, otherwise a static library made from Qwt's own source, which
# cmake/setup.sh has laid into build/qwt/source.

find_path(Qwt_INCLUDE_DIR qwt_plot.h PATH_SUFFIXES qt6/qwt qwt-qt6 qwt6 qwt)
find_library(Qwt_LIBRARY NAMES qwt-qt6 qwt)

set(Qwt_FOR_QT6 FALSE)
if(Qwt_LIBRARY AND NOT IS_DIRECTORY "${Qwt_LIBRARY}")
    # A Qwt for Qt 5 may bear the same name: the library itself tells which Qt it is linked with.
    file(STRINGS "${Qwt_LIBRARY}" Qwt_LINKED_QT REGEX "Qt6Widgets|QtWidgets\\.framework/Versions/A" LIMIT_COUNT 1)
    if(Qwt_LINKED_QT)
        set(Qwt_FOR_QT6 TRUE)
    endif()
endif()

if(Qwt_INCLUDE_DIR AND Qwt_FOR_QT6)
    set(Qwt_HEADER_DIR "${Qwt_INCLUDE_DIR}")
else()
    find_path(Qwt_SOURCE_DIR src/qwt_plot.h
        PATHS "${CMAKE_BINARY_DIR}/qwt/source" "${CMAKE_SOURCE_DIR}/build/qwt/source" NO_DEFAULT_PATH)
    if(Qwt_SOURCE_DIR)
        set(Qwt_HEADER_DIR "${Qwt_SOURCE_DIR}/src")
    endif()
endif()

if(Qwt_HEADER_DIR)
    file(STRINGS "${Qwt_HEADER_DIR}/qwt_global.h" Qwt_VERSION REGEX "define +QWT_VERSION_STR")
    string(REGEX REPLACE ".*\"(.*)\".*" "\\1" Qwt_VERSION "${Qwt_VERSION}")
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Qwt REQUIRED_VARS Qwt_HEADER_DIR VERSION_VAR Qwt_VERSION
    REASON_FAILURE_MESSAGE "run cmake/setup.sh first, or unpack Qwt 6.2 or later into build/qwt/source")

if(NOT Qwt_FOUND OR TARGET Qwt::Qwt)
    return()
endif()

find_package(Qt6 REQUIRED COMPONENTS Widgets Concurrent PrintSupport Svg)
set(Qwt_QT Qt6::Widgets Qt6::Concurrent Qt6::PrintSupport Qt6::Svg)

if(Qwt_FOR_QT6)
    add_library(Qwt::Qwt UNKNOWN IMPORTED)
    set_target_properties(Qwt::Qwt PROPERTIES
        IMPORTED_LOCATION "${Qwt_LIBRARY}"
        INTERFACE_INCLUDE_DIRECTORIES "${Qwt_HEADER_DIR}"
        INTERFACE_LINK_LIBRARIES "${Qwt_QT}")
    return()
endif()

file(GLOB Qwt_SOURCES "${Qwt_SOURCE_DIR}/src/qwt*.cpp")
list(FILTER Qwt_SOURCES EXCLUDE REGEX "/qwt_(polar_|plot_glcanvas|plot_opengl_canvas)")
# A file-local name of its own clashes with another file's in a common batch.
set_source_files_properties("${Qwt_SOURCE_DIR}/src/qwt_scale_div.cpp" PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)

add_library(qwt STATIC EXCLUDE_FROM_ALL ${Qwt_SOURCES})
add_library(Qwt::Qwt ALIAS qwt)
set_target_properties(qwt PROPERTIES AUTOMOC ON UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 16 EXPORT_COMPILE_COMMANDS OFF)
target_compile_definitions(qwt PRIVATE QWT_NO_OPENGL QT_NO_KEYWORDS)
target_compile_options(qwt PRIVATE -w -O1 -fno-sanitize=all)
target_include_directories(qwt SYSTEM PUBLIC "${Qwt_HEADER_DIR}")
target_link_libraries(qwt PUBLIC ${Qwt_QT})
