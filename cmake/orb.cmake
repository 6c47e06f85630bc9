# What every target of the project shares.

add_library(orb_options INTERFACE)
target_compile_options(orb_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wswitch-enum
  # gcc and clang must compute the same trace, so neither may fuse a multiplication with an addition.
  -ffp-contract=off)
target_include_directories(orb_options INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_definitions(orb_options INTERFACE ORB_VERSION="${PROJECT_VERSION}")

# Standalone Asio: headers only, without Boost.
add_library(orb_asio INTERFACE)
target_include_directories(orb_asio SYSTEM INTERFACE ${ASIO_INCLUDE_DIR})
target_compile_definitions(orb_asio INTERFACE ASIO_STANDALONE ASIO_NO_DEPRECATED)
target_link_libraries(orb_asio INTERFACE Threads::Threads)
add_library(orb::asio ALIAS orb_asio)

# orb_library(<folder> [PUBLIC lib...] [PRIVATE lib...]): the static library of one folder, all its
# .cpp files, alias orb::<folder>. A new file needs no edit here.
function(orb_library folder)
  cmake_parse_arguments(ARG "" "" "PUBLIC;PRIVATE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${folder}/*.cpp)
  add_library(orb_${folder} STATIC ${sources})
  add_library(orb::${folder} ALIAS orb_${folder})
  target_link_libraries(orb_${folder} PUBLIC orb_options ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
endfunction()
