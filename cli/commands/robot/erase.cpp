#include "cli/commands/commands.h"
#include "cli/model/checks.h"
#include "cli/robot/reach.h"

#include <fmt/format.h>
#include <memory>

namespace orb::cli {
namespace {

using spec::ApiCommand;

struct EraseOptions {
  PortOptions port;
  std::string area = "ram";
};

ExitCode erase(Context& context, uploader::Session& session, const std::string& area) {
  const auto number = area == "flash" ? spec::Area::Flash : spec::Area::Ram;
  struct Step {
    ApiCommand command;
    Bytes data;
    uploader::Known known;
  };
  const auto unchanged = fmt::format("the program in {} is unchanged", area);
  const Step steps[] = {
      // A running program locks its area.
      {ApiCommand::AbortOrbbasicProgram,
       {},
       {unchanged + ", but what was running may have been stopped; erase again", unchanged}},
      {ApiCommand::EraseOrbbasicStorage,
       {static_cast<std::uint8_t>(number)},
       {fmt::format("the program in {} is erased or unchanged; erase again", area),
        unchanged + ", but what was running has been stopped"}}};
  for (const auto& step : steps)
    if (const auto done = request(session, step.command, step.data, step.known); !done) {
      print_error(context, done.error().message);
      return exit_code(done.error().kind);
    }
  print_note(context, fmt::format("the program in {} is erased", area));
  return ExitCode::Done;
}

} // namespace

void add_erase(const Command& orb, Context& context) {
  const auto command = orb.add_command("erase", "erase the program in a ball's RAM or flash",
                                       "orb erase --port /dev/rfcomm0\n"
                                       "orb erase --port @red --area flash");
  auto options = std::make_shared<EraseOptions>();
  add_port_options(command, options->port);
  command.add_option("--area", options->area, "what is erased")
      .check(one_of({"ram", "flash"}))
      .show_default();
  command.callback([&context, options] {
    with_firmware(context, options->port,
                  [&](Link&, uploader::Session& session, const uploader::Greeting&) {
                    return erase(context, session, options->area);
                  });
  });
}

} // namespace orb::cli
