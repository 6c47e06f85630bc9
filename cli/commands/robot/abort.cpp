#include "cli/commands/commands.h"
#include "cli/robot/reach.h"
#include "protocol/payload.h"
#include "spec/basic.h"

#include <fmt/format.h>
#include <memory>

namespace orb::cli {
namespace {

using spec::ApiCommand;

constexpr auto command_at = spec::answer_offset(ApiCommand::AbortMacro, "command");

/// Reads the ball's message about a stopped program; nothing if none ran.
std::optional<std::uint16_t> stopped_line(uploader::Session& session) {
  (void)session.listen(session.now() + session.budgets().settle);
  for (const auto& message : session.inbox()) {
    if (message.id != static_cast<std::uint8_t>(spec::AsyncId::BasicError))
      continue;
    const auto fields =
        protocol::read_fields(spec::fields(spec::AsyncId::BasicError), message.data);
    if (fields.size() == 2 && fields[1].number == spec::code(spec::BasicError::UserAbort))
      return static_cast<std::uint16_t>(fields[0].number);
  }
  return std::nullopt;
}

ExitCode abort_all(Context& context, uploader::Session& session,
                   const uploader::Greeting& greeting) {
  session.inbox().clear();
  if (greeting.firmware.has_basic)
    if (const auto done = request(
            session, ApiCommand::AbortOrbbasicProgram, {},
            {"the program may still be running, and the macro was not stopped; abort again"});
        !done) {
      print_error(context, done.error().message);
      return exit_code(done.error().kind);
    }
  const auto program =
      std::string(greeting.firmware.has_basic ? "the program was stopped, but " : "");
  const auto macro = request(
      session, ApiCommand::AbortMacro, {},
      {program + "the macro may still be running; abort again", program + "the macro was not"});
  if (!macro) {
    print_error(context, macro.error().message);
    return exit_code(macro.error().kind);
  }
  const auto braked = uploader::brake(session);
  const auto line = stopped_line(session);
  const auto id = macro->data.front();
  const auto command = read_u16(macro->data, command_at);
  if (id != spec::macro_id_none && command == spec::macro_unkillable) {
    print_error(context, fmt::format("macro {} is a system macro that cannot be stopped", id));
    return ExitCode::Refused;
  }
  const auto of_macro = id == spec::macro_id_none
                            ? std::string("no macro was running")
                            : fmt::format("macro {} was stopped at command {}", id, command);
  print_note(context, line ? fmt::format("the program was stopped at line {}; {}", *line, of_macro)
                      : id != spec::macro_id_none ? of_macro + "; no program was running"
                                                  : "no program or macro was running");
  if (braked)
    return ExitCode::Done;
  print_error(context, "the ball may be rolling: it has not acknowledged a stop; abort again");
  return ExitCode::LinkLost;
}

} // namespace

void add_abort(const Command& orb, Context& context) {
  const auto command =
      orb.add_command("abort", "stop the program and the macro running on a ball, and its wheels",
                      "orb abort --port /dev/rfcomm0\norb abort --port @red");
  auto options = std::make_shared<PortOptions>();
  add_port_options(command, *options);
  command.callback([&context, options] {
    with_firmware(context, *options,
                  [&](Link&, uploader::Session& session, const uploader::Greeting& greeting) {
                    return abort_all(context, session, greeting);
                  });
  });
}

} // namespace orb::cli
