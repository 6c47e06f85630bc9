#include "cli/robot/newer_robot.h"

#include "cli/model/command.h"
#include "cli/terminal/interrupt.h"
#include "uploader/endpoint.h"

namespace orb::cli {

void add_newer_robot_option(const Command& command, std::string& robot) {
  command
      .add_option("--robot", robot,
                  "which robot answers there; over Bluetooth LE its name tells which")
      .check(one_of(names_of(spec::robots)));
}

const spec::RobotInfo* newer_robot(const Context& context, const PortOptions& options,
                                   std::string_view robot) {
  const auto* row = spec::find_robot(robot);
  if (row == nullptr)
    if (const auto named = named_robot(context.config, options.port))
      row = &spec::info(*named);
  return row != nullptr && row->packets == spec::Packets::V2 ? row : nullptr;
}

void with_newer_robot(Context& context, const PortOptions& options, const spec::RobotInfo& robot,
                      const std::function<tl::expected<void, Failure>(run::TalkV2&)>& work) {
  const InterruptGuard guard;
  auto port = options;
  port.robot = robot.robot;
  port.accepts = uploader::Accepts::All;
  auto link = open_link(context, port);
  if (!link)
    return fail(context, link.error());
  run::TalkV2 talk(*link->transport, robot);
  if (const auto done = work(talk); !done)
    fail(context, done.error());
  context.exit = link->finish(context, context.exit);
}

} // namespace orb::cli
