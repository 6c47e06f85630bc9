#include "cli/robot/sleep.h"

#include "run/tether/talk_v2.h"
#include "uploader/session.h"
#include "uploader/upload.h"

#include <fmt/format.h>

namespace orb::cli {
namespace {

tl::expected<void, std::string> tell_newer(protocol::Transport& transport,
                                           const spec::RobotInfo& robot) {
  run::TalkV2 talk(transport, robot);
  if (const auto done = talk.request(spec::V2Command::Sleep); !done)
    return tl::unexpected(done.error().message);
  return {};
}

/// Sends sleep without a wake-up time, macro or line.
tl::expected<void, std::string> tell_classic(protocol::Transport& transport, const Link& link) {
  constexpr std::size_t operands = 5;
  uploader::Session session(transport, link.budgets, link.first_seq);
  const auto done = request(session, spec::ApiCommand::Sleep, Bytes(operands, 0));
  if (!done)
    return tl::unexpected(done.error().message);
  return {};
}

} // namespace

void add_sleep_option(const Command& command, bool& sleeps) {
  command.add_flag("--sleep", sleeps, "put the robot to sleep at the end");
}

Slept put_to_sleep(protocol::Transport& transport, spec::Robot robot, const Link& link) {
  const auto& row = spec::info(robot);
  const auto told =
      row.packets == spec::Packets::V2 ? tell_newer(transport, row) : tell_classic(transport, link);
  if (told)
    return {ExitCode::Done, "the robot sleeps; connecting to it, or its charger, wakes it"};
  return {ExitCode::LinkLost,
          fmt::format("the robot has not acknowledged that it is to sleep: {}", told.error())};
}

Slept left_awake() {
  return {ExitCode::LinkLost, "the robot was not put to sleep: the link to it is lost"};
}

} // namespace orb::cli
