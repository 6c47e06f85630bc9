#include "base/duration.h"
#include "base/text/text.h"
#include "cli/commands/commands.h"
#include "cli/commands/robot/monitor.h"
#include "cli/context/json.h"
#include "cli/input/inputs.h"
#include "cli/input/target.h"
#include "cli/many/many.h"
#include "cli/model/checks.h"
#include "cli/robot/reach.h"
#include "cli/robot/sleep.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/progress_bar.h"
#include "run/delivery.h"
#include "run/lacks.h"
#include "run/tether/hail.h"
#include "spec/limits.h"

#include <fmt/format.h>
#include <memory>
#include <span>

namespace orb::cli {
namespace {

using uploader::Report;

/// The options of `orb upload`. Large because each of them is a field.
struct UploadOptions {
  RosterOptions roster;
  std::vector<std::string> files;
  std::string lang;
  TargetOptions target;
  PortOptions port;
  std::string format = "text";
  bool run = false;
  std::optional<int> run_line;
  std::string as;
  std::optional<int> id;
  bool clear_macros = false;
  bool force = false;
  bool monitor = false;
  bool sleeps = false;
  bool dry_run = false;
  bool no_check = false;
  int attempts = uploader::Budgets{}.attempts;
};

ExitCode fail_upload(const Context& context, ExitCode exit, std::string_view message) {
  print_error(context, message);
  return exit;
}

tl::expected<std::vector<run::Input>, Failure> load_all(const Context& context,
                                                        const UploadOptions& options) {
  auto inputs = read_inputs(options.files, options.lang, options.target.target());
  if (!inputs)
    return inputs;
  bool errors = false;
  bool sendable = true; // remains true if there is something to send
  for (const auto& input : *inputs) {
    errors =
        print_findings(context, options.no_check ? input.errors : run::findings(input)) || errors;
    sendable = sendable && (input.program || !input.macros.empty());
  }
  if (errors)
    return tl::unexpected(
        Failure{ExitCode::BadInput, fmt::format("nothing was sent: correct the errors above{}",
                                                sendable && !options.no_check
                                                    ? ", or send it as it is with `--no-check`"
                                                    : "")});
  return inputs;
}

run::DeliveryOptions delivery_options(const UploadOptions& options) {
  run::DeliveryOptions wanted;
  wanted.area = options.target.area == "flash" ? spec::Area::Flash : spec::Area::Ram;
  wanted.run = options.run;
  if (options.run_line)
    wanted.line = static_cast<std::uint16_t>(*options.run_line);
  if (options.as == "temp")
    wanted.kind = uploader::MacroKind::Temporary;
  else if (options.as == "user")
    wanted.kind = uploader::MacroKind::User;
  else if (options.as == "stream")
    wanted.kind = uploader::MacroKind::Stream;
  if (options.id)
    wanted.id = static_cast<std::uint8_t>(*options.id);
  wanted.clear_macros = options.clear_macros;
  return wanted;
}

void print_plan(const Context& context, std::string_view name, const uploader::Plan& plan) {
  const auto seconds = [](Duration t) { return static_cast<double>(t.count()) / 1e9; };
  const auto sent = packets(plan, 0);
  const auto pieces =
      plan.link_pieces == 0 ? std::string() : fmt::format(" and {} pieces", plan.link_pieces);
  auto text = fmt::format("{}: {} bytes to {} in {} packets{}, about {:.1f} s\n", name, plan.size,
                          to_string(plan.route), sent.size(), pieces, seconds(plan.expected));
  if (context.verbosity > 0)
    text += fmt::format("on a link that loses nearly everything it gives up after {:.0f} s\n",
                        seconds(plan.deadline));
  if (!plan.note.empty())
    text += fmt::format("note: {}\n", plan.note);
  for (const auto& packet : sent) {
    const auto* row = spec::find_command(packet.did, packet.cid);
    text += fmt::format("{:<28} {}\n", row == nullptr ? std::string_view("?") : row->name,
                        to_hex(encode(packet)));
  }
  print_out(text);
}

ExitCode dry_run(const Context& context, const UploadOptions& options,
                 const uploader::Delivery& delivery, uploader::Budgets budgets) {
  budgets.attempts = options.attempts;
  for (const auto& macro : delivery.macros) {
    const auto plan = make_plan(macro.job, budgets);
    if (!plan)
      return fail_upload(context, ExitCode::BadInput,
                         fmt::format("{}: {}", macro.name, plan.error().message));
    print_plan(context, macro.name, *plan);
  }
  if (delivery.program) {
    auto firmware = uploader::default_capabilities();
    if (options.target.ram != 0)
      firmware.ram_bytes = static_cast<std::size_t>(options.target.ram);
    const auto plan = make_plan(*delivery.program, firmware, budgets);
    if (!plan)
      return fail_upload(context, ExitCode::BadInput,
                         fmt::format("{}: {}", delivery.program_name, plan.error().message));
    print_plan(context, delivery.program_name, *plan);
  }
  return ExitCode::Done;
}

Lookup lookup_of(const std::vector<run::Input>& inputs) {
  const auto* first = run::first_with_program(inputs);
  return first == nullptr ? Lookup{} : Lookup{first->program->lines, first};
}

/// What stays uncertain after a success if the ball does not count packets.
std::string uncounted_note(std::size_t pieces) {
  constexpr double assumed = 0.01; // assumed share of duplicated or lost packets
  return fmt::format(
      "note: this ball does not count packets, so a duplicate piece goes unnoticed "
      "if an answer is lost as well: in at most {1:.2f} % of uploads of {2} piece{3} on "
      "a link that duplicates {0:.0f} % and loses {0:.0f} %; Bluetooth duplicates none",
      assumed * 100, uploader::unseen_bound(pieces, assumed, assumed) * 100, pieces,
      pieces == 1 ? "" : "s");
}

/// Why a ball with this firmware cannot run the program; nothing if it can. Prints all reasons for
/// a single robot; returns one sentence for each of several.
std::optional<std::string> newer_than(const Context& context, std::span<const run::Input> inputs,
                                      const uploader::Greeting& greeting, const Row* row) {
  const auto lacks = run::lacks_of(inputs, greeting.firmware);
  if (lacks.empty())
    return std::nullopt;
  for (const auto& lack : lacks)
    if (row == nullptr && lack.source != nullptr)
      print_finding(context, *lack.source, lack.finding);
  return fmt::format("{}; write it without, or send it as it is with `--no-check`",
                     run::in_words(lacks, greeting));
}

/// Reports the outcome; monitors the program if asked to.
ExitCode finish(const Context& context, const UploadOptions& options, Link& link,
                uploader::Session& session, const Report& report, Duration took,
                const Lookup& lookup, Row* row) {
  if (report.kind != Report::Kind::Done)
    return fail_upload(context, exit_code(report.kind), report.message);
  const auto done = fmt::format(
      "{}, {} packets sent, {:.2f} s{}", report.message, session.counts().packets_out,
      static_cast<double>(took.count()) / 1e9, link.is_sim ? ", on the built-in virtual ball" : "");
  if (row != nullptr)
    row->set_verdict(done);
  else
    print_note(context, done);
  if (report.uncounted > 0 && link.may_double)
    print_note(context, uncounted_note(report.uncounted));
  auto exit = ExitCode::Done;
  if (options.run && !options.monitor) {
    // A macro reports nothing when it fails.
    const auto began = lookup.input != nullptr ? watch_start(context, link, session, lookup)
                                               : Began{ExitCode::Done, "started"};
    if (began.exit != ExitCode::Done)
      return fail_upload(context, began.exit, began.words);
    if (row != nullptr)
      row->set_verdict(fmt::format("{}; {}", done, began.words));
    else
      print_note(context, began.words);
  }
  if (options.monitor) {
    const auto watched = monitor(context, link, session, lookup);
    exit = watched.faulted ? ExitCode::BadInput
           : watched.lost  ? ExitCode::LinkLost
                           : ExitCode::Done;
  }
  if (!options.sleeps)
    return exit;
  const auto slept = exit == ExitCode::LinkLost
                         ? left_awake()
                         : put_to_sleep(*link.transport, spec::Robot::Sphero, link);
  print_ended(context, slept.exit, slept.words);
  return exit == ExitCode::Done ? slept.exit : exit;
}

/// Explains why the robot at the other end takes no program.
ExitCode refuse_newer(const Context& context, const UploadOptions& options, Link& link) {
  const auto newer = find_newer(link, link.named);
  const auto why = newer ? stores_nothing(*newer, options.port.port) : newer.error();
  return fail_upload(context, why.code, why.message);
}

ExitCode send(const Context& context, const UploadOptions& options,
              const uploader::Delivery& delivery, const Lookup& lookup, Row* row) {
  // from here on, finish properly: the last report tells what is on the ball
  const InterruptGuard guard;
  uploader::OnBleStep on_step;
  if (row != nullptr)
    on_step = [row](auto step, const auto& found) { row->on_step(step, found); };
  auto link = open_link(context, options.port, on_step);
  if (!link)
    return fail_upload(context, link.error().code, link.error().message);
  link->budgets.attempts = options.attempts;
  if (link->packets == spec::Packets::V2)
    return link->finish(context, refuse_newer(context, options, *link));
  run::Hail hail(*link->transport);
  uploader::Session session(link->packets ? *link->transport : hail, link->budgets,
                            link->first_seq);
  const auto start = session.now();
  const auto battery =
      options.force ? uploader::BatteryPolicy::Ignore : uploader::BatteryPolicy::Refuse;
  Report report;
  if (row != nullptr) {
    report = deliver(session, delivery, battery, *row);
  } else {
    ProgressBar progress(context); // removed from the screen before anything else is printed
    report = deliver(session, delivery, battery, progress);
  }
  if (hail.answered() == spec::Packets::V2)
    return link->finish(context, refuse_newer(context, options, *link));
  return link->finish(context, finish(context, options, *link, session, report,
                                      session.now() - start, lookup, row));
}

/// Why one of several robots cannot take the upload.
std::optional<std::string> misfit(const UploadOptions& options, const RosterMember& member) {
  if (!member.robot || spec::info(*member.robot).packets == spec::Packets::V1)
    return std::nullopt;
  return fmt::format("is a {}, which stores no programs; omit it: `orb run {} {}--port {}` "
                     "drives it from here",
                     spec::info(*member.robot).title, options.files.front(),
                     options.roster.file.empty() ? "" : "--ports " + options.roster.file + " ",
                     member.port);
}

/// Prints the packets for a single robot: its link decides how they are packed.
void dry_run(Context& context, UploadOptions& options, const uploader::Delivery& delivery) {
  if (!options.roster.file.empty() || options.roster.ports.size() > 1)
    return cli::fail(context, {ExitCode::Usage, "`--dry-run` shows the packets for one robot; name "
                                                "it with `--port`"});
  if (!options.roster.ports.empty())
    options.port.port = options.roster.ports.front();
  const auto budgets = port_budgets(context, options.port);
  if (!budgets)
    return cli::fail(context, budgets.error());
  context.exit = dry_run(context, options, delivery, *budgets);
}

void upload(Context& context, UploadOptions& options) {
  if (options.sleeps && options.roster.ports.empty() && options.roster.file.empty())
    return cli::fail(context,
                     {ExitCode::Usage, "`--sleep` puts a robot to sleep; add `--port URL`"});
  if (options.sleeps && options.run && !options.monitor)
    return cli::fail(context,
                     {ExitCode::Usage, "`--sleep` would end what `--run` starts; omit one "
                                       "of them, or add `--monitor`: the robot then sleeps "
                                       "after Ctrl-C"});
  const auto inputs = load_all(context, options);
  if (!inputs)
    return cli::fail(context, inputs.error());
  auto delivery = run::arrange(*inputs, delivery_options(options));
  if (!delivery)
    return cli::fail(context, delivery.error());
  if (options.dry_run)
    return dry_run(context, options, *delivery);
  ManyOptions many;
  many.command = "upload";
  many.jobs = spec::ble_links_every;
  many.again = TryAgain::Lost;
  many.json = many.one_too = options.format == "json";
  many.check = [&]() -> tl::expected<void, Failure> {
    if (options.monitor)
      return tl::unexpected(listens_to_one());
    return {};
  };
  many.misfit = [&](const RosterMember& robot) { return misfit(options, robot); };
  with_robots(context, options.roster, many,
              [&](Context& own, const RosterMember& robot, Row* row) {
                auto one = options;
                one.port = port_of(one.port, robot, row);
                auto own_delivery = *delivery;
                own_delivery.port = robot.port;
                if (!options.no_check)
                  own_delivery.misfit = [&](const uploader::Greeting& greeting) {
                    return newer_than(own, *inputs, greeting, row);
                  };
                own.exit = send(own, one, own_delivery, lookup_of(*inputs), row);
              });
}

} // namespace

void add_upload(const Command& orb, Context& context) {
  const auto command = orb.add_command(
      "upload", "put programs and macros on a ball",
      "orb upload square.bas --port /dev/rfcomm0 --run\n"
      "orb upload dance.macro square.bas --port rfcomm://68:86:E7:00:11:22 --area flash\n"
      "orb upload square.bas --dry-run\n"
      "orb upload square.bas --port @red --port @blue\n"
      "orb upload square.bas --ports class.toml --run");
  auto options = std::make_shared<UploadOptions>();
  command.add_option("FILE", options->files, "sources or built macros; macros are sent first")
      .required();
  add_language_option(command, options->lang);
  add_roster_options(command, options->roster, links_at_once());
  add_link_options(command, options->port);
  add_format_option(command, options->format);
  add_target_options(command, options->target);
  command
      .add_option(
          "--run",
          [options](const std::string& line) {
            options->run = true;
            if (!line.empty())
              options->run_line = std::stoi(line);
          },
          "run it, from its first line or from LINE, and tell after at most a second whether it "
          "started or has stopped with an error")
      .value_optional()
      .type_name("LINE")
      .check([](const std::string& text) {
        return text.empty() || parse_number<std::uint16_t>(text).value_or(0) > 0
                   ? std::string()
                   : fmt::format("`{}` is not a line number; write one from {} to {}", text,
                                 spec::value_of(spec::Limit::LeastLineNumber),
                                 spec::value_of(spec::Limit::GreatestLineNumber));
      });
  command.add_option("--as", options->as, "how macros are kept")
      .check(one_of({"temp", "user", "stream"}));
  command.add_option("--id", options->id, "the id to save a macro under, 32 to 253")
      .check(whole_number(spec::macro_id_user_first, spec::macro_id_user_last))
      .type_name("N");
  command.add_flag("--clear-macros", options->clear_macros,
                   "clear all user macros from the ball first");
  command.add_flag("--force", options->force, "write to flash even if the battery is low");
  command.add_flag("--monitor", options->monitor, "then print what the ball sends, until Ctrl-C");
  add_sleep_option(command, options->sleeps);
  command.add_flag("--dry-run", options->dry_run,
                   "print the packets and send nothing; with -v, also when it would give up");
  command.add_flag("--no-check", options->no_check, "send it even if it has errors");
  constexpr int most_attempts = 1000;
  command
      .add_option("--attempts", options->attempts,
                  "how many times to send a program before giving up")
      .check(whole_number(1, most_attempts))
      .type_name("N")
      .show_default();
  command.callback([&context, options] { upload(context, *options); });
}

} // namespace orb::cli
