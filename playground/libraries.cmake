# What the modules link in the browser, and how it is made small.

include(../cmake/sources.cmake)
add_library(Threads::Threads INTERFACE IMPORTED) # there are none

target_compile_definitions(orb_fmt PRIVATE FMT_STATIC_THOUSANDS_SEPARATOR=',') # no locales
# Nothing but double is formatted.
target_compile_definitions(orb_fmt PUBLIC FMT_USE_FLOAT=0 FMT_USE_LONG_DOUBLE=0)
foreach(library orb_fmt orb_pugixml)
  target_compile_options(${library} PRIVATE -fignore-exceptions)
endforeach()
# PCRE2 stays without Unicode, whose tables are large: patterns search bytes, and ECMAScript has `\p{}` only with its
# flag `u`.
