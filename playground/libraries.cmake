# What the rooms link, for a compiler that must not see the system's own headers.

# Header-only libraries as Debian has them, by links in a folder of this build.
set(headers ${CMAKE_BINARY_DIR}/include)
file(MAKE_DIRECTORY ${headers})
foreach(library tao nlohmann tl)
  if(NOT IS_DIRECTORY /usr/include/${library})
    message(FATAL_ERROR "/usr/include/${library} is missing; ./dev playground installs what is needed")
  endif()
  file(REMOVE_RECURSE ${headers}/${library})
  file(CREATE_LINK /usr/include/${library} ${headers}/${library} SYMBOLIC)
endforeach()

add_library(orb_headers INTERFACE)
target_include_directories(orb_headers SYSTEM INTERFACE ${headers})
foreach(name taocpp::pegtl nlohmann_json::nlohmann_json tl::expected)
  add_library(${name} ALIAS orb_headers)
endforeach()
add_library(Threads::Threads INTERFACE IMPORTED) # there are none

# Those that are more than headers: their sources, as Debian has them (playground/build fetches them).
set(fmt ${ORB_SOURCES}/fmtlib-9.1.0+ds1)
add_library(orb_fmt STATIC ${fmt}/src/format.cc)
target_include_directories(orb_fmt SYSTEM PUBLIC ${fmt}/include)
target_compile_definitions(orb_fmt PRIVATE FMT_STATIC_THOUSANDS_SEPARATOR=',') # no locales
# Nothing but double is formatted.
target_compile_definitions(orb_fmt PUBLIC FMT_USE_FLOAT=0 FMT_USE_LONG_DOUBLE=0)
target_compile_options(orb_fmt PRIVATE -fignore-exceptions)
add_library(fmt::fmt ALIAS orb_fmt)

set(pugixml ${ORB_SOURCES}/pugixml-1.13/src)
add_library(orb_pugixml STATIC ${pugixml}/pugixml.cpp)
target_include_directories(orb_pugixml SYSTEM PUBLIC ${pugixml})
target_compile_options(orb_pugixml PRIVATE -fignore-exceptions)
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
# Without Unicode, whose tables are large: patterns search bytes, and ECMAScript has `\p{}` only with its flag `u`.
target_compile_definitions(orb_pcre2 PUBLIC PCRE2_STATIC
  PRIVATE HAVE_CONFIG_H PCRE2_CODE_UNIT_WIDTH=8 SUPPORT_PCRE2_8 NEWLINE_DEFAULT=2)
add_library(PkgConfig::PCRE2 ALIAS orb_pcre2)
