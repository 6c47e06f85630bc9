#include "cli/commands/robot/monitor.h"

#include "base/duration.h"
#include "cli/commands/commands.h"
#include "cli/commands/robot/watch_newer.h"
#include "cli/context/json.h"
#include "cli/input/inputs.h"
#include "cli/terminal/interrupt.h"
#include "disk/disk.h"
#include "protocol/describe.h"
#include "protocol/payload.h"
#include "report/page.h"
#include "report/svg.h"
#include "run/began.h"
#include "run/start.h"
#include "run/tether/onlooker.h"
#include "spec/basic.h"
#include "spec/macro.h"
#include "structured/text/structured_words.h"

#include <fmt/format.h>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace orb::cli {
namespace {

using protocol::Async;
using protocol::LinkError;
using spec::AsyncId;

/// How long the built-in ball may be silent before checking if anything still runs.
constexpr Duration look = 100ms;

bool is(const Async& message, AsyncId id) {
  return message.id == static_cast<std::uint8_t>(id);
}

/// Looks up a fault in the source; nothing without a source.
std::optional<run::ProgramError> explain_error(const run::ReportedFault& reported,
                                               const Lookup& lookup) {
  const auto known = spec::find_error(reported.code);
  if (!known || lookup.input == nullptr)
    return std::nullopt;
  return run::explain(*lookup.input, reported.line, *known, nullptr);
}

std::string place(const run::LineMap& lines, std::uint32_t robot_line) {
  const auto words = lines.words(robot_line);
  return words.empty() ? words : words + ": ";
}

/// Prints a fault that a ball reports; only its number if the robot's table does not have it.
void print_fault(const Context& context, const Lookup& lookup, const run::ReportedFault& reported) {
  if (const auto fault = explain_error(reported, lookup)) {
    print_fault(context, *fault);
    return;
  }
  const auto known = spec::find_error(reported.code);
  const auto where = place(lookup.lines, reported.line);
  const bool named = !where.empty() && lookup.lines.known == run::Known::FileAndColumn;
  print_err(fmt::format("{}{}: {}{}\n", where, context.err_style().paint(Role::Error, "error"),
                        named ? std::string() : fmt::format("line {}: ", reported.line),
                        known ? std::string(spec::info(*known).text)
                              : fmt::format("error {:02X}h", reported.code)));
}

/// A message as JSON; a fault includes place and cause.
void print_json_message(const Async& message, const Lookup& lookup, Watched& watched) {
  auto json = message_json(message);
  const auto reported = run::fault_in(message);
  watched.faulted |= reported.has_value();
  if (const auto fault = reported ? explain_error(*reported, lookup) : std::nullopt) {
    json["file"] = fault->file;
    json["line"] = fault->place.line;
    json["column"] = fault->place.column;
    if (!fault->cause.seen.empty())
      json["detail"] = fault->cause.seen;
    if (const auto& help = run::help_of(*fault); !help.empty())
      json["help"] = in_english(help);
  }
  print_json(json);
}

/// A message as `NAME: FIELD VALUE, …`, without its frame. The end of a macro, which arrives as a
/// special marker, is a sentence.
std::string message_words(const Async& message) {
  const auto packet = encode(message);
  const auto parts = protocol::Describer().parts(item_of(message, packet));
  const auto number = [&](std::size_t field) { return parts.fields[field].number.value_or(0); };
  if (is(message, AsyncId::MacroMarker) && parts.fields.size() == 3 &&
      number(0) == spec::macro_end_marker)
    return fmt::format("macro {} ended", number(1));
  std::vector<std::string> fields;
  for (const auto& field : parts.fields)
    fields.push_back(field.number && field.text.empty()
                         ? fmt::format("{} {}", field.name, *field.number)
                         : fmt::format("{} {}", field.name, field.text));
  if (!parts.rest.empty())
    fields.push_back(to_hex(parts.rest));
  return fmt::format("{}: {}", parts.name, fmt::join(fields, ", "));
}

void print_message(const Context& context, const Async& message, const Lookup& lookup,
                   Watched& watched) {
  if (is(message, AsyncId::BasicPrint)) {
    print_out(as_text(message.data));
    return;
  }
  if (is(message, AsyncId::BasicErrorText))
    return; // some messages are binary
  if (const auto reported = run::fault_in(message)) {
    watched.faulted = true;
    print_fault(context, lookup, *reported);
    return;
  }
  print_out(message_words(message) + "\n");
}

} // namespace

void print_fault(const Context& context, const run::ProgramError& fault) {
  print_err(run::render(fault, context.err_style()));
}

std::string robot_goes_on(const Link& link) {
  return fmt::format("what runs on the ball goes on; `orb abort --port {0}` stops it, `orb monitor "
                     "--port {0}` listens again",
                     link.name);
}

Watched monitor(const Context& context, Link& link, uploader::Session& session,
                const Lookup& lookup, std::string_view format, Spectator* spectator) {
  Watched watched;
  auto& inbox = session.inbox();
  while (true) {
    while (!inbox.empty()) {
      if (spectator != nullptr && spectator->takes(inbox.front())) {
        // a format for programs
      } else if (format == "json")
        print_json_message(inbox.front(), lookup, watched);
      else
        print_message(context, inbox.front(), lookup, watched);
      inbox.pop_front();
    }
    const auto resting = link.is_sim && link.ball->idle();
    const auto heard = session.listen(session.now() + look, [&] { return !inbox.empty(); });
    if (!heard) {
      const auto why = heard.error().link.kind;
      watched.lost = why != LinkError::Kind::Interrupted && why != LinkError::Kind::Ended;
      if (watched.lost)
        print_error(context,
                    fmt::format("{}; {}", heard.error().link.message, robot_goes_on(link)));
      return watched;
    }
    if (resting && inbox.empty())
      return watched;
    if (spectator != nullptr && !spectator->goes_on())
      return watched;
  }
}

Began watch_start(const Context& context, const Link& link, uploader::Session& session,
                  const Lookup& lookup) {
  const auto began = run::watch_start(session, lookup.lines);
  if (began.fault) {
    print_fault(context, lookup, *began.fault);
    return {ExitCode::BadInput, began.words};
  }
  if (!began.unheard || began.unheard->link.kind == LinkError::Kind::Ended)
    return {ExitCode::Done, began.words};
  if (began.unheard->link.kind == LinkError::Kind::Interrupted)
    return {ExitCode::Interrupted,
            "interrupted; the program was started, and " + robot_goes_on(link)};
  return {ExitCode::LinkLost, fmt::format("the program was started, then the link was lost: {}; {}",
                                          began.unheard->link.message, robot_goes_on(link))};
}

namespace {

struct MonitorOptions {
  PortOptions port;
  std::string robot;
  std::string map;
  std::string format = "text";
  std::string report; ///< file for the report; empty for none
  std::string svg;
  std::string time; ///< how long to listen; empty: until interrupted

  bool draws() const { return !report.empty() || !svg.empty(); }
};

/// Records a ball that is driven by its own program.
class Camera final : public Spectator {
public:
  Camera(uploader::Session& session, Duration lasts, report::Journey* journey)
      : session_(session), lasts_(lasts), began_(session.now()) {
    if (journey != nullptr)
      onlooker_.emplace(*journey);
  }

  /// Starts the sensor stream.
  tl::expected<void, Failure> begin() {
    return onlooker_ ? ask_all(onlooker_->stream()) : tl::expected<void, Failure>();
  }
  void end() {
    if (onlooker_ && !ended_)
      static_cast<void>(ask_all(onlooker_->silence())); // the link may be gone
    ended_ = true;
  }
  /// Also ends the stream if nobody reads any more.
  ~Camera() override { end(); }
  Camera(const Camera&) = delete;
  Camera& operator=(const Camera&) = delete;

  bool takes(const Async& message) override {
    if (!onlooker_)
      return false;
    onlooker_->hear(time(), message);
    return is(message, AsyncId::SensorData);
  }

  bool goes_on() override { return lasts_ == Duration{} || time() < lasts_; }

  Duration time() const { return session_.now() - began_; }

private:
  tl::expected<void, Failure> ask_all(const std::vector<run::Request>& requests) {
    for (const auto& one : requests) {
      const auto answer =
          session_.ask(static_cast<spec::ApiCommand>(one.did << 8 | one.cid), one.data);
      if (!answer)
        return tl::unexpected(Failure{ExitCode::LinkLost,
                                      "the ball does not answer when asked for its "
                                      "sensors; bring it closer, and try again"});
      if (answer->code != 0)
        return tl::unexpected(
            Failure{ExitCode::Refused, fmt::format("the ball does not stream its sensors: {}",
                                                   uploader::describe_code(answer->code))});
    }
    return {};
  }

  uploader::Session& session_;
  Duration lasts_;
  Instant began_;
  std::optional<run::Onlooker> onlooker_;
  bool ended_ = false;
};

/// Writes the report and the drawing.
tl::expected<void, IoError> write_seen(const MonitorOptions& options, report::Journey& journey,
                                       Duration time) {
  journey.finish(time, "abort", "watched");
  if (!options.report.empty())
    if (auto done =
            disk::write(options.report, as_bytes(report::report_page(journey, options.port.port, {},
                                                                     structured::keyword_words)));
        !done)
      return done;
  return options.svg.empty() ? tl::expected<void, IoError>()
                             : disk::write(options.svg, as_bytes(report::path_svg(journey)));
}

ExitCode watch(Context& context, const MonitorOptions& options, Duration lasts,
               const Lookup& lookup, std::span<const run::Input> inputs, Link& link,
               uploader::Session& session) {
  report::Journey journey;
  run::describe(inputs, {}, journey);
  Camera camera(session, lasts, options.draws() ? &journey : nullptr);
  if (auto begun = camera.begin(); !begun) {
    print_error(context, begun.error().message);
    return begun.error().code;
  }
  print_note(context, lasts == Duration{} ? "listening; Ctrl-C to stop" : "listening");
  const auto watched = monitor(context, link, session, lookup, options.format, &camera);
  camera.end();
  if (options.draws())
    if (auto written = write_seen(options, journey, camera.time()); !written) {
      print_error(context, written.error().message);
      return ExitCode::File;
    }
  return watched.lost ? ExitCode::LinkLost : ExitCode::Done;
}

tl::expected<run::LineMap, Failure> read_map(const std::string& path) {
  const auto text = read_text(path);
  if (!text)
    return tl::unexpected(text.error());
  auto map = run::parse_line_map(*text);
  if (!map)
    return tl::unexpected(
        Failure{ExitCode::File, fmt::format("{} is not a map written by `orb build --map`", path)});
  return *std::move(map);
}

/// Reads the program that a map belongs to. Nothing if the file is gone, or if only the map knows
/// line places because the source has no numbers.
std::vector<run::Input> read_program(const run::LineMap& map) {
  if (map.files.empty() || map.known == run::Known::FileAndColumn)
    return {};
  auto inputs = read_inputs({map.files.front()}, "basic", {});
  return inputs && inputs->front().program ? *std::move(inputs) : std::vector<run::Input>();
}

/// Explains why a robot that stores no programs has no page.
Failure draws_nothing(const Newer& robot, std::string_view port) {
  return {ExitCode::Usage,
          fmt::format("the robot is {}, which runs no programs by itself; `orb run PROGRAM --port "
                      "{} --report OUT.html` drives it and shows where it went",
                      with_article(robot.title), port)};
}

void listen(Context& context, const MonitorOptions& options) {
  Lookup lookup;
  std::vector<run::Input> inputs;
  if (!options.map.empty()) {
    auto map = read_map(options.map);
    if (!map)
      return fail(context, map.error());
    lookup.lines = *std::move(map);
    inputs = read_program(lookup.lines);
    lookup.input = inputs.empty() ? nullptr : &inputs.front();
  }
  const auto lasts = options.time.empty() ? Duration{} : parse_duration(options.time, 1s);
  if (!lasts)
    return fail(context,
                {ExitCode::Usage, fmt::format("`--for {}` is not a duration; write it like "
                                              "90s, 500ms or 2min",
                                              options.time)});
  const auto classic = [&](Link& link, uploader::Session& session,
                           const uploader::Greeting& greeting) {
    if (const auto refused = refuse_bootloader(greeting, link.name)) {
      print_error(context, refused->message);
      return exit_code(refused->kind);
    }
    return watch(context, options, *lasts, lookup, inputs, link, session);
  };
  const auto newer = [&](Link& link, run::TalkV2&,
                         const Newer& robot) -> tl::expected<void, Failure> {
    if (options.draws())
      return tl::unexpected(draws_nothing(robot, options.port.port));
    return watch_newer(context, link, robot, *lasts, options.format);
  };
  with_robot(context, options.port, options.robot, {classic, newer});
}

} // namespace

void add_monitor(const Command& orb, Context& context) {
  const auto command =
      orb.add_command("monitor", "print what a ball says: output, errors, markers, collisions",
                      "orb monitor --port /dev/rfcomm0\n"
                      "orb monitor --port @red --map square.json\n"
                      "orb monitor --port ble://SB-1A2B --for 30s\n"
                      "orb monitor --port @red --report drive.html --for 30s");
  auto options = std::make_shared<MonitorOptions>();
  add_port_options(command, options->port);
  add_robot_option(command, options->robot);
  add_format_option(command, options->format);
  command
      .add_option("--map", options->map,
                  "a map written by `orb build --map`: errors then point into the source")
      .type_name("FILE");
  command.add_option("--report", options->report, "a page with the ball's path and sensor readings")
      .type_name("OUT.html");
  command.add_option("--svg", options->svg, "a drawing of the path").type_name("OUT.svg");
  command.add_option("--for", options->time, "how long to listen; by default until Ctrl-C")
      .type_name("TIME");
  command.callback([&context, options] { listen(context, *options); });
}

} // namespace orb::cli
