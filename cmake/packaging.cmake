# `cpack -G DEB` in the build folder: one package with both programs, what the desktop needs to know of them, and their manual pages.
set(CPACK_PACKAGE_NAME faintline)
set(CPACK_PACKAGE_VENDOR Faintline)
set(CPACK_PACKAGE_CONTACT "Faintline maintainers <maintainers@users.noreply.faintline.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "workbench for track-before-detect")
set(CPACK_PACKAGE_DESCRIPTION
"Opens recordings of sonar, radar, radio and sound, detects in them what is
too faint to see, and shows the detector thinking: input and statistic side
by side, with the threshold in false alarms per hour.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL runtime)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME faintline)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS OFF)
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "${CPACK_PACKAGE_DESCRIPTION}")
include(CPack)
