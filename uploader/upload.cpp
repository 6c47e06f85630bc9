#include "uploader/upload_run.h"

#include "spec/firmware.h"

#include <cmath>
#include <fmt/format.h>

namespace orb::uploader {

namespace {

constexpr auto power_state_at = spec::answer_offset(ApiCommand::GetPowerState, "power state");

double seconds(Duration duration) {
  return static_cast<double>(duration.count()) / 1e9;
}

/// Refuses a battery that might not last through a flash write.
std::optional<Report> check_battery(const Greeting& greeting, BatteryPolicy policy) {
  const auto state = greeting.power_state();
  if (policy == BatteryPolicy::Ignore ||
      (state != spec::power_state::low && state != spec::power_state::critical))
    return std::nullopt;
  return Report{Report::Kind::Refused, Content::Unchanged,
                fmt::format("the battery is {} ({:02X}h), and a write to flash that is cut short "
                            "loses the program; the ball is unchanged; charge it, or use `--force`",
                            spec::value_name("power state", state), state),
                0};
}

/// Explains from what was received why no ball answered.
std::string no_ball(const Session& session, const NoAnswer& failure) {
  const auto& counts = session.counts();
  if (failure.kind == NoAnswer::Kind::Link)
    return failure.link.message;
  const auto tried = fmt::format("no answer to {} pings", session.budgets().sends);
  if (counts.echoes > 0)
    return tried + "; what is sent comes back unchanged: this is an echo (a terminal, a loop-back "
                   "plug), not a ball";
  if (counts.foreign_answers > 0)
    return tried + "; answers came, but to other sequence numbers: another program is talking to "
                   "this ball, or it is not a ball";
  if (counts.bytes_in > 0)
    return fmt::format("{}; {} bytes came that are not an answer: the other end is not a ball",
                       tried, counts.bytes_in);
  return tried + "; is the ball awake (shake it), charged and not connected to a phone?";
}

} // namespace

Report refused(ApiCommand command, const Response& response, Content content,
               std::string_view state) {
  const auto* row = spec::find_response(response.code);
  return {Report::Kind::Refused, content,
          fmt::format("the ball refused {}: {}{}{}{}", spec::info(command).name,
                      describe_code(response.code), state,
                      row == nullptr || row->remedy.empty() ? "" : "; ",
                      row == nullptr ? "" : row->remedy),
          response.code};
}

Report lost(const Session& session, ApiCommand command, const NoAnswer& failure, Content content,
            std::string_view state) {
  const auto name = spec::info(command).name;
  if (is_interruption(failure))
    return {Report::Kind::Interrupted, content, fmt::format("interrupted{}", state), 0};
  return {content == Content::Unconfirmed ? Report::Kind::Unknown : Report::Kind::LinkLost, content,
          failure.kind == NoAnswer::Kind::Link
              ? fmt::format("link lost during {}: {}{}", name, failure.link.message, state)
              : fmt::format("no reply to {} within {:g} s{}", name,
                            seconds(session.budgets().answer), state),
          0};
}

// A piece arrives once with probability (1−d)(1−q)² or d·2q(1−q)². It arrives twice, with one of
// its answers lost so that it looks like once, with d(1−q)²·2q(1−q). Everything else restarts the
// upload.
double unseen_bound(std::size_t pieces, double doubled, double lost) {
  const auto arrives = (1 - lost) * (1 - lost);
  const auto once = (1 - doubled) * arrives + doubled * 2 * lost * arrives;
  const auto twice_unseen = doubled * arrives * 2 * lost * (1 - lost);
  return 1 - std::pow(once / (once + twice_unseen), static_cast<double>(pieces));
}

ExitCode exit_code(Report::Kind kind) {
  switch (kind) {
  case Report::Kind::Done: return ExitCode::Done;
  case Report::Kind::Impossible: return ExitCode::BadInput;
  case Report::Kind::Refused: return ExitCode::Refused;
  case Report::Kind::NoBall: return ExitCode::NoBall;
  case Report::Kind::LinkLost: return ExitCode::LinkLost;
  case Report::Kind::Unknown: return ExitCode::Unknown;
  case Report::Kind::Interrupted: return ExitCode::Interrupted;
  }
  return ExitCode::Bug;
}

std::uint8_t Greeting::power_state() const {
  return power && power->size() > power_state_at ? (*power)[power_state_at] : std::uint8_t{0};
}

std::string describe_firmware(const Greeting& greeting) {
  const auto field = [&](std::size_t at) {
    return at < greeting.versions.size() ? greeting.versions[at] : std::uint8_t{0};
  };
  constexpr unsigned nibble = 16;
  const auto basic = field(spec::version_orbbasic_at);
  return fmt::format("firmware {}.{}, {}, macro executive {}", field(spec::version_firmware_at),
                     field(spec::version_firmware_at + 1),
                     basic == 0 ? std::string("no orbBasic")
                                : fmt::format("orbBasic {}.{}", basic / nibble, basic % nibble),
                     field(spec::version_macro_at));
}

std::string_view to_string(Stage stage) {
  switch (stage) {
  case Stage::Greeting: return "greeting";
  case Stage::Preparing: return "preparing";
  case Stage::Sending: return "sending";
  case Stage::Confirming: return "confirming";
  case Stage::Storing: return "storing";
  case Stage::Starting: return "starting";
  case Stage::Done: return "done";
  }
  return {};
}

tl::expected<Greeting, Report> greet(Session& session) {
  constexpr std::string_view unchanged = "the ball is unchanged";
  const auto state = fmt::format("; {}", unchanged);
  const auto absent = [&](const NoAnswer& failure) {
    if (is_interruption(failure))
      return tl::unexpected(lost(session, ApiCommand::Ping, failure, Content::Unchanged, state));
    return tl::unexpected(
        Report{Report::Kind::NoBall, Content::Unchanged, no_ball(session, failure), 0});
  };
  if (const auto drained = session.drain(); !drained)
    return absent(drained.error());
  if (const auto pong = session.ask(ApiCommand::Ping); !pong)
    return absent(pong.error());
  Greeting greeting;
  auto versions = request(session, ApiCommand::GetVersioning, {},
                          {std::string(unchanged), std::string(unchanged)});
  if (!versions)
    return tl::unexpected(versions.error());
  greeting.versions = versions->data;
  greeting.firmware = read_capabilities(greeting.versions);
  const auto power = session.ask(ApiCommand::GetPowerState);
  if (!power)
    return tl::unexpected(
        lost(session, ApiCommand::GetPowerState, power.error(), Content::Unchanged, state));
  if (is_ok(*power))
    greeting.power = power->data;
  return greeting;
}

namespace {

/// Returns true if a command only queries the ball.
bool only_asks(ApiCommand command) {
  const auto name = spec::info(command).name;
  return command == ApiCommand::Ping || name.starts_with("get-") || name.starts_with("poll-");
}

/// Describes the ball after a command without answer.
std::string after_silence(ApiCommand command) {
  if (only_asks(command))
    return "the ball is unchanged";
  return fmt::format(
      "it is not known whether the ball has carried out {}{}", spec::info(command).name,
      spec::info(command).idempotent == spec::Idempotent::Yes ? "; sending it again does no harm"
                                                              : "");
}

} // namespace

tl::expected<Response, Report> request(Session& session, ApiCommand command, const Bytes& data,
                                       const Known& known) {
  const auto harmless = spec::info(command).idempotent == spec::Idempotent::Yes;
  const auto answer = harmless ? session.ask(command, data) : session.exchange(command, data);
  if (answer && is_ok(*answer))
    return *answer;
  if (answer)
    return tl::unexpected(
        refused(command, *answer, Content::Unchanged,
                known.if_refused.empty() ? std::string() : "; " + known.if_refused));
  auto report = lost(session, command, answer.error(), Content::Unchanged,
                     "; " + (known.if_lost.empty() ? after_silence(command) : known.if_lost));
  if (!harmless && report.kind == Report::Kind::LinkLost)
    report.kind = Report::Kind::Unknown;
  return tl::unexpected(report);
}

std::string bootloader_remedy(std::string_view port) {
  return fmt::format("`orb exec leave-bootloader --port {}` starts the firmware; if that is "
                     "refused, charge the ball and let the vendor's app write its firmware again",
                     port);
}

std::optional<Report> refuse_bootloader(const Greeting& greeting, std::string_view port) {
  if (!greeting.firmware.in_bootloader)
    return std::nullopt;
  return Report{
      Report::Kind::Refused, Content::Unchanged,
      fmt::format("the ball is in its bootloader, where nothing runs; it is unchanged; {}",
                  bootloader_remedy(port)),
      0};
}

Report commit(Session& session, const Greeting& greeting, BatteryPolicy battery) {
  if (auto refused = refuse_bootloader(greeting))
    return *refused;
  if (!greeting.firmware.can_commit)
    return {Report::Kind::Refused, Content::Unchanged,
            "this firmware cannot commit RAM to flash (API 1.47 can); upload with `--area flash`",
            0};
  if (auto low = check_battery(greeting, battery))
    return *low;
  Plan plan;
  plan.route = Route::RamThenFlash;
  plan.again = "commit again";
  plan.steps = {{StepKind::Prepare, ApiCommand::AbortOrbbasicProgram},
                {StepKind::Store, ApiCommand::CommitRamToFlash}};
  NullProgress nobody;
  return Upload(session, plan, nobody).run("the program in RAM is now in flash");
}

namespace {

/// Finds problems that are foreseeable before anything is sent.
std::optional<Report> foresee(const Session& session, const Delivery& delivery,
                              const Greeting& greeting, BatteryPolicy battery) {
  const auto impossible = [](const std::string& name, const std::string& why) {
    return Report{Report::Kind::Impossible, Content::Unchanged,
                  name.empty() ? why : fmt::format("{}: {}", name, why), 0};
  };
  const auto named = [&](const std::string& name) {
    return delivery.macros.size() + (delivery.program ? 1 : 0) > 1 ? name : std::string();
  };
  for (const auto& macro : delivery.macros)
    if (const auto plan = make_plan(macro.job, session.budgets()); !plan)
      return impossible(named(macro.name), plan.error().message);
  if (const auto& job = delivery.program) {
    if (const auto plan = make_plan(*job, greeting.firmware, session.budgets()); !plan)
      return impossible(named(delivery.program_name), plan.error().message);
    if (job->area == Area::Flash)
      if (auto low = check_battery(greeting, battery))
        return low;
  }
  if (delivery.misfit)
    if (const auto why = delivery.misfit(greeting))
      return impossible({}, *why);
  return std::nullopt;
}

} // namespace

Report deliver(Session& session, const Delivery& delivery, BatteryPolicy battery,
               Progress& progress) {
  const auto greeting = greet(session);
  if (!greeting)
    return greeting.error();
  if (auto refused = refuse_bootloader(*greeting, delivery.port))
    return *refused;
  if (auto trouble = foresee(session, delivery, *greeting, battery))
    return *trouble;
  Report report;
  std::string stored;
  const auto several = delivery.macros.size() + (delivery.program ? 1 : 0) > 1;
  const auto done = [&](const std::string& name, Report next) {
    next.uncounted += report.uncounted;
    report = std::move(next);
    const auto is_done = report.kind == Report::Kind::Done;
    if (several)
      report.message = fmt::format("{}: {}", name, report.message);
    if (is_done)
      stored += (stored.empty() ? "" : "; ") + report.message;
    else if (!stored.empty())
      report.message += fmt::format(" (before that: {})", stored);
    return is_done;
  };
  for (const auto& macro : delivery.macros) {
    progress.on_item(macro.name);
    if (!done(macro.name, upload(session, macro.job, progress)))
      return report;
  }
  if (delivery.program) {
    progress.on_item(delivery.program_name);
    if (!done(delivery.program_name,
              upload(session, *delivery.program, *greeting, battery, progress)))
      return report;
  }
  report.message = stored;
  return report;
}

Report upload(Session& session, const ProgramJob& job, const Greeting& greeting,
              BatteryPolicy battery, Progress& progress) {
  const auto plan = make_plan(job, greeting.firmware, session.budgets());
  if (!plan)
    return {Report::Kind::Impossible, Content::Unchanged, plan.error().message, 0};
  if (job.area == Area::Flash)
    if (auto low = check_battery(greeting, battery))
      return *low;
  return Upload(session, *plan, progress)
      .run(fmt::format("{} bytes in {}", plan->size, job.area == Area::Flash ? "flash" : "RAM"));
}

Report upload(Session& session, const MacroJob& job, Progress& progress) {
  const auto plan = make_plan(job, session.budgets());
  if (!plan)
    return {Report::Kind::Impossible, Content::Unchanged, plan.error().message, 0};
  return Upload(session, *plan, progress)
      .run(fmt::format("{} bytes as {}", plan->size, to_string(plan->route)));
}

} // namespace orb::uploader
