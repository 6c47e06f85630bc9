# The libraries of a build for another system, whose compiler must not see the headers of this one.
# ORB_SOURCES is the folder that cmake/sources has filled.

# orb_header_folder(<folder> <name>...): header-only libraries as Debian has them, by links in one folder.
function(orb_header_folder folder)
  file(MAKE_DIRECTORY ${folder})
  foreach(library ${ARGN})
    if(NOT EXISTS /usr/include/${library})
      message(FATAL_ERROR "/usr/include/${library} is missing; ./dev installs what is needed")
    endif()
    file(REMOVE_RECURSE ${folder}/${library})
    file(CREATE_LINK /usr/include/${library} ${folder}/${library} SYMBOLIC)
  endforeach()
endfunction()

orb_header_folder(${CMAKE_BINARY_DIR}/include tao nlohmann tl)
add_library(orb_headers INTERFACE)
target_include_directories(orb_headers SYSTEM INTERFACE ${CMAKE_BINARY_DIR}/include)
foreach(name taocpp::pegtl nlohmann_json::nlohmann_json tl::expected)
  add_library(${name} ALIAS orb_headers)
endforeach()

# Those that are more than headers: their sources.
set(fmt ${ORB_SOURCES}/fmtlib-9.1.0+ds1)
add_library(orb_fmt STATIC ${fmt}/src/format.cc)
target_include_directories(orb_fmt SYSTEM PUBLIC ${fmt}/include)
add_library(fmt::fmt ALIAS orb_fmt)

set(pugixml ${ORB_SOURCES}/pugixml-1.13/src)
add_library(orb_pugixml STATIC ${pugixml}/pugixml.cpp)
target_include_directories(orb_pugixml SYSTEM PUBLIC ${pugixml})
add_library(pugixml::pugixml ALIAS orb_pugixml)

set(pcre2 ${ORB_SOURCES}/pcre2-10.42/src)
set(pcre2_made ${CMAKE_BINARY_DIR}/pcre2)
configure_file(${pcre2}/pcre2.h.generic ${pcre2_made}/pcre2.h COPYONLY)
configure_file(${pcre2}/config.h.generic ${pcre2_made}/config.h COPYONLY)
configure_file(${pcre2}/pcre2_chartables.c.dist ${pcre2_made}/pcre2_chartables.c COPYONLY)
set(pcre2_files auto_possess compile config context convert dfa_match error extuni find_bracket maketables match
  match_data newline ord2utf pattern_info script_run serialize string_utils study substitute substring tables ucd
  valid_utf xclass)
list(TRANSFORM pcre2_files REPLACE "(.+)" "${pcre2}/pcre2_\\1.c")
add_library(orb_pcre2 STATIC ${pcre2_files} ${pcre2_made}/pcre2_chartables.c)
target_include_directories(orb_pcre2 SYSTEM PUBLIC ${pcre2_made})
target_include_directories(orb_pcre2 PRIVATE ${pcre2})
target_compile_definitions(orb_pcre2 PUBLIC PCRE2_STATIC
  PRIVATE HAVE_CONFIG_H PCRE2_CODE_UNIT_WIDTH=8 SUPPORT_PCRE2_8 NEWLINE_DEFAULT=2)
add_library(PkgConfig::PCRE2 ALIAS orb_pcre2)
