# The C++ package: what `find_package(orb)` and `pkg-config orb` find after `cmake --install`
# (docs/using/library.md). The modules below the console, with their headers under include/orb/.

set(library_modules base spec protocol bytecode repair compiler assembler structured vm uploader report robot run)

# The headers that others may build on. What they include is installed beside them; nothing else is.
set(library_headers
  base/bytes.h base/diagnostic.h base/exit_code.h base/fixes.h base/random.h base/render.h base/source.h
  base/style.h base/time.h
  spec/api.h spec/basic.h spec/firmware.h spec/limits.h spec/macro.h
  protocol/decoder.h protocol/describe.h protocol/macro.h protocol/packet.h protocol/packet_v2.h protocol/payload.h
  protocol/payload_v2.h protocol/recording.h protocol/transport.h
  compiler/check.h compiler/text/image.h compiler/lint/lint.h compiler/load.h compiler/text/print.h
  assembler/assemble.h assembler/disassemble.h
  structured/compile.h structured/text/files.h structured/lift/lift.h
  vm/ball.h vm/ball_transport.h vm/observer.h vm/stimulus.h
  uploader/endpoint.h uploader/plan.h uploader/session.h uploader/upload.h
  report/course.h report/journey.h report/page.h report/svg.h report/trace.h
  robot/robot.h
  run/input.h run/run.h)

# Copies a file and what it includes, so that `#include "module/x.h"` becomes `#include "orb/module/x.h"`: a
# program of others may have a folder `run/` of its own.
set(library_include ${CMAKE_BINARY_DIR}/library/include)
function(orb_library_header file)
  get_property(seen GLOBAL PROPERTY library_seen)
  if(file IN_LIST seen)
    return()
  endif()
  set_property(GLOBAL APPEND PROPERTY library_seen ${file})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${file})
  set(ours "#(include|define ORB_[A-Z]+) \"([a-z_]+/[a-z0-9_/]+\\.(h|def|inc))\"")
  file(STRINGS ${PROJECT_SOURCE_DIR}/${file} includes REGEX "${ours}")
  foreach(line ${includes})
    string(REGEX REPLACE ".*${ours}.*" "\\2" included "${line}")
    orb_library_header(${included})
  endforeach()
  file(READ ${PROJECT_SOURCE_DIR}/${file} text)
  string(REGEX REPLACE "${ours}" "#\\1 \"orb/\\2\"" text "${text}")
  file(CONFIGURE OUTPUT ${library_include}/orb/${file} CONTENT "${text}" @ONLY)
endfunction()
foreach(header ${library_headers})
  orb_library_header(${header})
endforeach()
file(CONFIGURE OUTPUT ${library_include}/orb/version.h @ONLY CONTENT [[
#pragma once

// The version of the installed library: semantic, see docs/using/library.md.
#define ORB_VERSION "@PROJECT_VERSION@"
#define ORB_VERSION_MAJOR @PROJECT_VERSION_MAJOR@
#define ORB_VERSION_MINOR @PROJECT_VERSION_MINOR@
#define ORB_VERSION_PATCH @PROJECT_VERSION_PATCH@
]])

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/orb)
install(DIRECTORY ${library_include}/orb DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT dev)
foreach(module ${library_modules})
  target_include_directories(orb_${module} INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(orb_${module} PUBLIC cxx_std_20)
  set_target_properties(orb_${module} PROPERTIES EXPORT_NAME ${module})
  install(TARGETS orb_${module} EXPORT orb ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev)
  list(PREPEND link_order -lorb_${module})
endforeach()
install(EXPORT orb NAMESPACE orb:: DESTINATION ${package} FILE orbTargets.cmake COMPONENT dev)

get_target_property(vm_links orb_vm LINK_LIBRARIES)
if(asmjit::asmjit IN_LIST vm_links)
  set(library_native ON)
  set(library_links -lasmjit)
else()
  set(library_native OFF)
endif()
get_target_property(uploader_links orb_uploader LINK_LIBRARIES)
if(SDBusCpp::sdbus-c++ IN_LIST uploader_links)
  set(library_ble ON)
  list(APPEND library_links -lsdbus-c++)
else()
  set(library_ble OFF)
endif()
list(JOIN library_links " " library_links)
list(JOIN library_modules ", " library_modules)
configure_package_config_file(cmake/orbConfig.cmake.in ${CMAKE_BINARY_DIR}/library/orbConfig.cmake
  INSTALL_DESTINATION ${package})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/library/orbConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/library/orbConfig.cmake ${CMAKE_BINARY_DIR}/library/orbConfigVersion.cmake
        DESTINATION ${package} COMPONENT dev)

# pkg-config finds the rest from where the file is: the package may be moved.
list(JOIN link_order " " link_order)
file(RELATIVE_PATH up ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/library/orb.pc @ONLY CONTENT [[
prefix=${pcfiledir}/@up@
includedir=${prefix}/@CMAKE_INSTALL_INCLUDEDIR@
libdir=${prefix}/@CMAKE_INSTALL_LIBDIR@

Name: orb
Description: @PROJECT_DESCRIPTION@
Version: @PROJECT_VERSION@
Requires: fmt pugixml
Libs: -L${libdir} @link_order@ @library_links@
Cflags: -I${includedir}
]])
install(FILES ${CMAKE_BINARY_DIR}/library/orb.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT dev)
