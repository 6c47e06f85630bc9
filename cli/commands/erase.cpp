#include "cli/commands.h"
#include "cli/link.h"
#include "cli/options.h"

#include <fmt/format.h>
#include <memory>

namespace orb::cli {
namespace {

using spec::ApiCommand;

struct Options {
  PortOptions port;
  std::string area = "ram";
};

ExitCode erase(Context& context, uploader::Session& session, const std::string& area) {
  const auto number = area == "flash" ? spec::Area::Flash : spec::Area::Ram;
  // A running program holds its area.
  for (const auto& [command, data] :
       {std::pair{ApiCommand::AbortOrbbasicProgram, Bytes{}},
        std::pair{ApiCommand::EraseOrbbasicStorage, Bytes{static_cast<std::uint8_t>(number)}}})
    if (const auto done = request(session, command, data); !done) {
      const auto& report = done.error();
      const auto maybe = command == ApiCommand::EraseOrbbasicStorage &&
                         report.kind == uploader::Report::Kind::LinkLost;
      print_error(context, maybe ? fmt::format("no answer to the erase; the program in {} is "
                                               "erased or unchanged; erase again",
                                               area)
                                 : report.message);
      return exit_code(report.kind);
    }
  print_note(context, fmt::format("the program in {} is erased", area));
  return ExitCode::Done;
}

} // namespace

void add_erase(CLI::App& app, Context& context) {
  auto* command = add_command(app, "erase", "erase the program in a ball's RAM or flash",
                              "orb erase --port /dev/rfcomm0\n"
                              "orb erase --port @red --area flash");
  auto options = std::make_shared<Options>();
  add_port_options(*command, options->port);
  command->add_option("--area", options->area, "what is erased")
      ->check(one_of({"ram", "flash"}))
      ->capture_default_str();
  command->callback([&context, options] {
    with_ball(context, options->port,
              [&](Link&, uploader::Session& session, const uploader::Greeting&) {
                return erase(context, session, options->area);
              });
  });
}

} // namespace orb::cli
