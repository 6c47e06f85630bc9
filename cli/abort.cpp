#include "cli/commands.h"
#include "cli/link.h"

#include <fmt/format.h>
#include <memory>

namespace orb::cli {
namespace {

using spec::ApiCommand;

constexpr std::size_t abort_answer_size = 3;         // API §Abort Macro: id and command number
constexpr std::uint16_t unkillable_command = 0xFFFF; // API §Abort Macro

ExitCode abort_all(Context& context, uploader::Session& session,
                   const uploader::Greeting& greeting) {
  if (greeting.firmware.has_basic)
    if (const auto done = request(session, ApiCommand::AbortOrbbasicProgram); !done) {
      print_error(context, done.error().message);
      return exit_code(done.error().kind);
    }
  const auto macro = request(session, ApiCommand::AbortMacro);
  if (!macro) {
    print_error(context, macro.error().message);
    return exit_code(macro.error().kind);
  }
  const auto id = macro->data.size() >= abort_answer_size ? macro->data[0] : std::uint8_t{0};
  if (id != 0 && read_u16(macro->data, 1) == unkillable_command) {
    print_error(context, fmt::format("macro {} is a system macro that cannot be stopped", id));
    return ExitCode::Refused;
  }
  print_note(context, id == 0 ? "no program and no macro runs"
                              : fmt::format("macro {} was stopped in command {}; no program runs",
                                            id, read_u16(macro->data, 1)));
  return ExitCode::Done;
}

} // namespace

void add_abort(CLI::App& app, Context& context) {
  auto* command = add_command(app, "abort", "stop the program and the macro that run on a ball",
                              "orb abort --port /dev/rfcomm0\norb abort --port @red");
  auto options = std::make_shared<PortOptions>();
  add_port_options(*command, *options);
  command->callback([&context, options] {
    with_ball(context, *options,
              [&](Link&, uploader::Session& session, const uploader::Greeting& greeting) {
                return abort_all(context, session, greeting);
              });
  });
}

} // namespace orb::cli
