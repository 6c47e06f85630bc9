#include "cli/commands/commands.h"
#include "cli/robot/reach.h"

#include <fmt/format.h>
#include <memory>

namespace orb::cli {
namespace {

struct CommitOptions {
  PortOptions port;
  bool force = false;
};

ExitCode commit(Context& context, uploader::Session& session, const uploader::Greeting& greeting,
                const CommitOptions& options) {
  const auto done = uploader::commit(session, greeting,
                                     options.force ? uploader::BatteryPolicy::Ignore
                                                   : uploader::BatteryPolicy::Refuse);
  if (done.kind != uploader::Report::Kind::Done) {
    print_error(context, done.message);
    return exit_code(done.kind);
  }
  print_note(context, done.message);
  return ExitCode::Done;
}

} // namespace

void add_commit(const Command& orb, Context& context) {
  const auto command =
      orb.add_command("commit", "copy the program in a ball's RAM to its flash",
                      "orb commit --port /dev/rfcomm0\norb commit --port @red --force");
  auto options = std::make_shared<CommitOptions>();
  add_port_options(command, options->port);
  command.add_flag("--force", options->force, "commit even if the battery is low");
  command.callback([&context, options] {
    with_firmware(context, options->port,
                  [&](Link&, uploader::Session& session, const uploader::Greeting& greeting) {
                    return commit(context, session, greeting, *options);
                  });
  });
}

} // namespace orb::cli
