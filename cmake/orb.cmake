# What every target of the project shares, in its own build and in the browser's.

cmake_path(GET CMAKE_CURRENT_LIST_DIR PARENT_PATH ORB_ROOT)

add_library(orb_options INTERFACE)
target_compile_options(orb_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wswitch-enum
  # gcc and clang must compute the same trace, so neither may fuse a multiplication with an addition.
  -ffp-contract=off)
target_include_directories(orb_options INTERFACE ${ORB_ROOT})
target_compile_definitions(orb_options INTERFACE ORB_VERSION="${PROJECT_VERSION}")

# Precompiled headers: what nearly every file of a kind includes from outside the project, and nothing of
# the project itself, so that editing a header of ours never rebuilds them. The clang preset builds without
# them, so that every file still names what it uses.
function(orb_precompiled name)
  set(source ${CMAKE_BINARY_DIR}/precompiled_${name}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "// Holds nothing: its target owns a precompiled header.\n")
  add_library(precompiled_${name} OBJECT ${source})
  cmake_parse_arguments(ARG "" "" "LIBRARIES;HEADERS" ${ARGN})
  target_link_libraries(precompiled_${name} PRIVATE orb_options ${ARG_LIBRARIES})
  target_precompile_headers(precompiled_${name} PRIVATE ${ARG_HEADERS})
endfunction()
set(headers_std <algorithm> <array> <charconv> <chrono> <cmath> <cstdint> <deque> <fmt/format.h> <functional>
    <limits> <map> <memory> <numeric> <optional> <set> <span> <string> <string_view> <tl/expected.hpp> <utility>
    <variant> <vector>)
orb_precompiled(modules LIBRARIES fmt::fmt HEADERS ${headers_std})
orb_precompiled(json_modules LIBRARIES fmt::fmt nlohmann_json::nlohmann_json HEADERS ${headers_std} <nlohmann/json.hpp>)

option(ORB_JOIN "Compile the files of a module together: sooner from nothing, later after an edit" OFF)
if(ORB_JOIN AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # gcc tidies up its memory again and again from some 100 MB on, which takes a sixth of the time of long units.
  target_compile_options(orb_options INTERFACE --param=ggc-min-heapsize=500000)
endif()

# With ORB_DEMO, what the demo does not show is not compiled; cli/commands/left_out.cpp stands for its commands.
set(ORB_NOT_SHOWN "cli/commands/(completion|decode|disasm|encode|fmt|lift|man|spec|test)\\.cpp"
  "cli/commands/robot/(abort|calibrate|checkup|commit|doctor|drive|erase|exec|info)\\.cpp" cli/editors/
  reference/cheatsheet reference/manual "run/calibrate/(measuring_drive|fit)" serve/page_server
  structured/lift/ testing/judge testing/replay testing/run_ testing/sighting "testing/verdicts/(merge|pupils|render|render_[^j]+|render_json|report|table)\\.cpp")
# Joined by themselves: folders whose private names the rest of their module has too.
set(ORB_APART editor/dap editor/languages/basic editor/languages/macro editor/languages/structured editor/languages/test
  editor/lsp editor/printed run/calibrate structured/lift testing/text testing/verdicts vm/api vm/machine vm/macros vm/machine/native)

# orb_join(<target>): with ORB_JOIN, the files of one module are compiled together, up to thirty at a time. They see each
# other's private names, so a module has no such name twice. A file with options of its own stays alone.
function(orb_join target)
  if(NOT ORB_JOIN)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    cmake_path(ABSOLUTE_PATH source)
    cmake_path(RELATIVE_PATH source BASE_DIRECTORY ${ORB_ROOT})
    set(group ${target})
    foreach(folder IN LISTS ORB_APART)
      if(source MATCHES "^${folder}/")
        string(REPLACE "/" "_" group ${folder})
      endif()
    endforeach()
    math(EXPR part "(0${count_${group}}) / 30")
    math(EXPR count_${group} "0${count_${group}} + 1")
    set_source_files_properties(${ORB_ROOT}/${source} PROPERTIES UNITY_GROUP ${group}_${part})
  endforeach()
  # Two warnings are for files alone: here a name of another file may be hidden, and no file is the main one.
  set(before "#pragma GCC diagnostic ignored \"-Wshadow\"")
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    string(APPEND before "\n#pragma GCC diagnostic ignored \"-Wsubobject-linkage\"")
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP
    UNITY_BUILD_CODE_BEFORE_INCLUDE "${before}")
endfunction()

# orb_library(<folder> [JSON] [PUBLIC lib...] [PRIVATE lib...]): the static library of one folder, all its .cpp files,
# alias orb::<folder>; JSON: most of them see that library. A new file needs no edit here. On Windows NAME_windows.cpp stands in for NAME.cpp.
function(orb_library folder)
  cmake_parse_arguments(ARG "JSON" "" "PUBLIC;PRIVATE" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${ORB_ROOT}/${folder}/*.cpp)
  set(windows ${sources})
  list(FILTER windows INCLUDE REGEX "_windows\\.cpp$")
  if(WIN32)
    list(TRANSFORM windows REPLACE "_windows\\.cpp$" ".cpp")
  endif()
  list(REMOVE_ITEM sources "" ${windows})
  if(ORB_DEMO)
    foreach(path IN LISTS ORB_NOT_SHOWN)
      list(FILTER sources EXCLUDE REGEX "^${ORB_ROOT}/${path}")
    endforeach()
  endif()
  set(kind modules)
  if(ARG_JSON)
    set(kind json_modules)
  endif()
  add_library(orb_${folder} STATIC ${sources})
  add_library(orb::${folder} ALIAS orb_${folder})
  target_link_libraries(orb_${folder} PUBLIC $<BUILD_INTERFACE:orb_options> ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  target_precompile_headers(orb_${folder} REUSE_FROM precompiled_${kind})
  orb_join(orb_${folder})
endfunction()

# orb_page(<folder> <name> <script>...): NAME.html, NAME.css and the modules NAME/SCRIPT.js, written as real
# files, travel inside the folder's library as the texts that assets.h declares. The modules become one
# script: they share a scope, so each stands after those that it imports, and no two have a name in common.
function(orb_page folder name)
  set(page_js "(() => {\n\"use strict\";\n")
  foreach(script IN LISTS ARGN)
    orb_page_text(text ${name}/${script}.js)
    string(REGEX REPLACE "\nimport [^;]*;" "" text "\n${text}")
    string(REGEX REPLACE "\nexport " "\n" text "${text}")
    string(APPEND page_js "${text}")
  endforeach()
  string(APPEND page_js "})();\n")
  orb_page_text(page_html ${name}.html)
  orb_page_text(page_css ${name}.css)
  set(assets "#include \"${folder}/assets.h\"\n\nnamespace orb::${folder} {\n")
  foreach(kind html css js)
    string(APPEND assets "const std::string_view page_${kind} = R\"asset(${page_${kind}})asset\";\n")
  endforeach()
  string(APPEND assets "} // namespace orb::${folder}\n")
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/${folder}_assets.cpp CONTENT "${assets}" @ONLY)
  # No compiler in use knows the limit that the standard lets a literal have.
  set_source_files_properties(${CMAKE_BINARY_DIR}/${folder}_assets.cpp PROPERTIES COMPILE_OPTIONS -Wno-overlength-strings)
  target_sources(orb_${folder} PRIVATE ${CMAKE_BINARY_DIR}/${folder}_assets.cpp)
endfunction()

# orb_page_text(<variable> <path>): the text of a file, read again by CMake when it changes.
function(orb_page_text variable path)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${ORB_ROOT}/${path})
  file(READ ${ORB_ROOT}/${path} text)
  set(${variable} "${text}" PARENT_SCOPE)
endfunction()

# orb_translations(<module>): findings, verdicts and lessons in each language travel inside the program (cli/context/language.h).
function(orb_translations module)
  file(GLOB languages CONFIGURE_DEPENDS ${ORB_ROOT}/translations/*.json)
  set(rows "")
  foreach(file ${languages})
    cmake_path(GET file STEM code)
    orb_page_text(text translations/${code}.json)
    set(texts "")
    foreach(part findings verdicts lessons) # one object of them
      string(JSON object GET "${text}" ${part})
      string(REGEX REPLACE "^{|[ \n]*}$" "" members "${object}")
      string(APPEND texts "${members},")
    endforeach()
    string(REGEX REPLACE ",$" "" texts "${texts}")
    string(APPEND rows "  {\"${code}\", R\"json({${texts}})json\"},\n")
  endforeach()
  string(CONCAT translations "#include \"cli/context/language.h\"\n\nnamespace orb::cli {\nnamespace {\n"
    "constexpr Translation rows[] = {\n${rows}};\n} // namespace\n\n"
    "std::span<const Translation> translations() {\n  return rows;\n}\n} // namespace orb::cli\n")
  set(made ${CMAKE_BINARY_DIR}/${module}_translations.cpp)
  file(CONFIGURE OUTPUT ${made} CONTENT "${translations}" @ONLY)
  set_source_files_properties(${made} PROPERTIES COMPILE_OPTIONS -Wno-overlength-strings)
  target_sources(orb_${module} PRIVATE ${made})
endfunction()
