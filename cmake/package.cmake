# A Debian package of what `cmake --install` installs: `cpack -G DEB` in the build folder.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME orb)
set(CPACK_PACKAGE_CONTACT "orb developers <orb@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "toolchain for Sphero robots")
set(CPACK_PACKAGE_DESCRIPTION
"Writes, checks, simulates and flashes orbBasic programs and macros for Sphero
robots, offline or over Bluetooth.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION devel)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
include(CPack)
