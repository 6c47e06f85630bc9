# ORB_STATIC: a program without shared libraries, which runs on any Linux of its processor
# (packaging/tarball). Debian has archives of all libraries but D-Bus, which is left out there, and fmt, which is
# made of its headers: one file that keeps every inline function is what libfmt.a would be.

file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/static/fmt.cpp CONTENT "#define FMT_HEADER_ONLY\n#include <fmt/format.h>\n")
add_library(fmt_static STATIC ${CMAKE_BINARY_DIR}/static/fmt.cpp)
target_compile_features(fmt_static PRIVATE cxx_std_20)
target_compile_options(fmt_static PRIVATE -fkeep-inline-functions)
set_target_properties(fmt_static PROPERTIES ARCHIVE_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/static)
set_target_properties(fmt::fmt PROPERTIES IMPORTED_LOCATION_NONE ${CMAKE_BINARY_DIR}/static/libfmt_static.a)
add_dependencies(fmt::fmt fmt_static)
set_target_properties(pugixml::pugixml PROPERTIES INTERFACE_LINK_LIBRARIES pugixml::static)
# Position-independent, as Debian compiles anyway: in a plain static program gcc's runtime sorts the tables of all
# functions before the first exception, and CLI11 ends `--version` with one: 11 ms instead of 4.
add_link_options(-static-pie)
# It relocates itself before main(), and gives up where a path to shared libraries is named.
set(CMAKE_SKIP_RPATH ON)
