# `cpack -G DEB` in the build folder: a package with both programs, what the desktop needs to know of them, and their manual pages, one with the
# Python module, and one with the Vamp plug-in.
set(CPACK_PACKAGE_NAME faintline)
set(CPACK_PACKAGE_VENDOR Faintline)
set(CPACK_PACKAGE_CONTACT "Faintline maintainers <maintainers@users.noreply.faintline.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "workbench for track-before-detect")
set(CPACK_PACKAGE_DESCRIPTION
"Opens recordings of sonar, radar, radio and sound, detects in them what is
too faint to see, and shows the detector thinking: the input above what was
found, with the threshold in false alarms per hour.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL runtime)
if(TARGET faintline_python)
    list(APPEND CPACK_COMPONENTS_ALL python)
endif()
if(TARGET faintline_vamp)
    list(APPEND CPACK_COMPONENTS_ALL vamp)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME faintline)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS OFF)
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "${CPACK_PACKAGE_DESCRIPTION}")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-faintline)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_COMPONENT_PYTHON_DESCRIPTION
"Python module: detects in recordings and in arrays what is too faint to see, with the same
results as the programs of the package faintline: events, tracks, statistics
and their explanations as numpy arrays.")
set(CPACK_DEBIAN_VAMP_PACKAGE_NAME faintline-vamp-plugin)
set(CPACK_DEBIAN_VAMP_PACKAGE_SECTION sound)
set(CPACK_COMPONENT_VAMP_DESCRIPTION
"Vamp plug-in: finds faint lines in hosts such as Sonic Visualiser and Audacity, with
the same results as the programs of the package faintline.")
# A compiled module is for one minor version of the interpreter.
if(DEFINED FAINTLINE_PYTHON_VERSION)
    string(REGEX MATCH "^[0-9]+" pythonMajor ${FAINTLINE_PYTHON_VERSION})
    string(REGEX REPLACE "^[0-9]+\\." "" pythonMinor ${FAINTLINE_PYTHON_VERSION})
    math(EXPR pythonNext "${pythonMinor} + 1")
    set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
        "python3-numpy, python3 (>= ${FAINTLINE_PYTHON_VERSION}), python3 (<< ${pythonMajor}.${pythonNext})")
endif()
include(CPack)
