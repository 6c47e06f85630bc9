# The rooms that need no operating system, in floor order: a folder links only what stands above it here
# (docs/architecture.md). The browser's build (playground/) reads this list, too; whoever includes it has
# found the libraries.

# Headers only, and none of ours includes them: who links an installed room need not have them.
set(pegtl $<BUILD_INTERFACE:taocpp::pegtl>)
set(json $<BUILD_INTERFACE:nlohmann_json::nlohmann_json>)

orb_library(base       PUBLIC fmt::fmt PRIVATE ${json})
orb_library(spec       PUBLIC fmt::fmt)
orb_library(protocol   PUBLIC orb::spec orb::base tl::expected)
orb_library(bytecode   PUBLIC orb::spec orb::base)
orb_library(repair     PUBLIC orb::spec orb::base)
orb_library(compiler   PUBLIC orb::bytecode orb::repair PRIVATE ${pegtl})
orb_library(assembler  PUBLIC orb::protocol orb::repair PRIVATE ${pegtl})
orb_library(structured PUBLIC orb::compiler orb::assembler PRIVATE ${pegtl})
orb_library(vm         PUBLIC orb::protocol orb::bytecode)
orb_library(uploader   PUBLIC orb::protocol PRIVATE ${links})
orb_library(report     PUBLIC orb::vm PRIVATE ${json} pugixml::pugixml)
orb_page(report        report/page
  dom journey playback heading matrix readings map_chart map_ground map_marks map_path map
  source variables events lists lanes transport paper keys player report)
orb_library(run        PUBLIC orb::report orb::structured orb::uploader PRIVATE ${json})
orb_library(testing    PUBLIC orb::run PRIVATE ${json} PkgConfig::PCRE2 Threads::Threads)
orb_library(reference  PUBLIC orb::testing PRIVATE ${json})
orb_library(debug      PUBLIC orb::testing)
orb_library(editor     JSON PUBLIC orb::reference orb::debug PRIVATE ${json})
