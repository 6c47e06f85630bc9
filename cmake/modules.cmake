# The modules of the project, lowest first: a folder may include what it links here, and what that links. CMakeLists.txt
# adds `disk` and `serve`, cli/CMakeLists.txt `cli`. tests/modules_test.cpp reads these files and checks every #include;
# the browser's build (playground/) and the one for Windows include this one after they have found the libraries.

# Headers only, and none of ours includes them: who links an installed module need not have them.
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
orb_library(robot      PUBLIC orb::report orb::compiler)
orb_library(run        PUBLIC orb::report orb::structured orb::uploader PRIVATE ${json})
orb_library(testing    PUBLIC orb::run PRIVATE ${json} PkgConfig::PCRE2 Threads::Threads)
orb_library(reference  PUBLIC orb::testing PRIVATE ${json})
orb_library(debug      PUBLIC orb::testing)
orb_library(editor     JSON PUBLIC orb::reference orb::debug PRIVATE ${json})

# Built elsewhere: playground/CMakeLists.txt and python/CMakeLists.txt.
set(links_playground editor robot)
set(links_python playground robot)

# The layers of a module, lowest first: its folders, and `.` for its own files. A file includes from its own layer and
# from those before it.
set(layers_base text . render)
set(layers_protocol . capture judge)
set(layers_compiler text messages analyse lint .)
set(layers_assembler text . lint)
set(layers_structured text layout meaning lower analyse optimise emit . lift)
set(layers_vm body common machine macros api . room)
set(layers_testing text . verdicts)
set(layers_editor . languages lsp dap printed)
set(layers_cli model bluez context input terminal robot many ball run room editors commands .)
