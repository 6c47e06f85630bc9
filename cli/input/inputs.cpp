#include "cli/input/inputs.h"

#include "base/render.h"
#include "cli/context/language.h"
#include "cli/model/command.h"
#include "disk/disk.h"
#include "testing/texts.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace orb::cli {

void add_language_option(const Command& command, std::string& lang) {
  command.add_option("--lang", lang, "the language, if the file's extension does not say")
      .check(one_of({"basic", "structured", "macro"}));
}

tl::expected<std::string, Failure> read_text(const std::string& path) {
  if (leads_through_link(path))
    return Links().read(path);
  auto text = disk::read(path);
  if (!text)
    return tl::unexpected(Failure{ExitCode::File, text.error().message});
  return *std::move(text);
}

std::optional<std::string> DiskFiles::read(const std::string& path) {
  if (leads_through_link(path)) {
    auto text = links_.read(path);
    return text ? std::optional(*std::move(text)) : std::nullopt;
  }
  // Reading anything but a regular file can block forever.
  if (!disk::what_else(path).empty())
    return std::nullopt;
  // `-` is a file name here, never standard input
  auto text = disk::read(path == "-" ? "./-" : path);
  return text ? std::optional(*std::move(text)) : std::nullopt;
}

Message DiskFiles::obstacle(const std::string& path) {
  return disk::what_else(path);
}

Message DiskFiles::trouble(const std::string& path) {
  if (leads_through_link(path)) {
    const auto text = links_.read(path);
    return text ? Message() : Message::as_is(text.error().message);
  }
  if (const auto other = disk::what_else(path); !other.empty())
    return testing::texts::CannotReadBecause(path, texts::ItIs(other));
  const auto text = disk::read(path == "-" ? "./-" : path);
  return text ? Message() : Message::as_is(text.error().message);
}

std::string DiskFiles::identity(const std::string& path) {
  std::error_code unknown; // for a file that does not exist
  const auto real = std::filesystem::canonical(disk::as_path(path), unknown);
  return unknown ? Files::identity(path) : real.string();
}

tl::expected<run::SourceFile, Failure> read_source(const std::string& path, std::string_view lang) {
  auto text = read_text(path);
  if (!text)
    return tl::unexpected(text.error());
  const auto name = disk::display_name(path);
  const bool bytes = run::holds_macro_bytes(path) && (lang.empty() || lang == "macro");
  if (bytes) {
    auto made = run::macro_source(name, *text);
    if (!made)
      return tl::unexpected(made.error());
    return run::SourceFile{path, run::Language::Macro, Source(name, *std::move(made)), bytes};
  }
  const auto language = run::language_of(path, lang);
  if (!language)
    return tl::unexpected(run::unknown_content(name));
  return run::SourceFile{path, *language, Source(name, *std::move(text))};
}

tl::expected<std::vector<run::Input>, Failure> read_inputs(const std::vector<std::string>& paths,
                                                           std::string_view lang,
                                                           const compiler::Target& target) {
  std::vector<run::Input> inputs;
  DiskFiles files;
  for (const auto& path : paths) {
    auto text = read_text(path);
    if (!text)
      return tl::unexpected(text.error());
    auto input = run::read_input(disk::display_name(path), *std::move(text), lang, target, files);
    if (!input)
      return tl::unexpected(input.error());
    run::add_input(inputs, *std::move(input));
  }
  return inputs;
}

void add_stimulus_option(const Command& command, std::vector<std::string>& stimuli) {
  command
      .add_option("--stimulus", stimuli,
                  "what happens to the ball: a script, or one line such as `at 2s shake`")
      .one_value_each()
      .type_name("FILE|LINE");
}

bool is_stimulus_line(const std::string& given) {
  return vm::is_stimulus_line(given) && !std::filesystem::exists(disk::as_path(given));
}

tl::expected<std::vector<vm::TimedStimulus>, Failure>
read_stimuli(const Context& context, const std::vector<std::string>& given) {
  std::vector<vm::TimedStimulus> events;
  for (const auto& one : given) {
    const bool is_line = is_stimulus_line(one);
    auto text = is_line ? tl::expected<std::string, Failure>(one) : read_text(one);
    if (!text)
      return tl::unexpected(text.error());
    const Source source(is_line ? "--stimulus" : disk::display_name(one), *std::move(text));
    const auto script = vm::parse_stimulus(source);
    if (!script.diagnostics.empty()) {
      print_findings(context, source, script.diagnostics);
      return tl::unexpected(Failure{ExitCode::BadInput, "the stimulus script has errors"});
    }
    events.insert(events.end(), script.events.begin(), script.events.end());
  }
  vm::sort_by_time(events);
  return events;
}

void add_course_option(const Command& command, std::string& path) {
  command
      .add_option("--course", path,
                  "what the ball drives through: walls, zones and a start, as SVG")
      .type_name("FILE.svg");
}

tl::expected<report::Course, Failure> read_course(const Context& context, const std::string& path) {
  auto text = read_text(path);
  if (!text)
    return tl::unexpected(text.error());
  const Source drawing(disk::display_name(path), *std::move(text));
  auto reading = report::read_course(drawing);
  if (print_findings(context, drawing, reading.findings))
    return tl::unexpected(
        Failure{ExitCode::BadInput, fmt::format("the course {} has errors", drawing.name())});
  return std::move(reading.course);
}

void print_finding(const Context& context, const Source& source, const Diagnostic& diagnostic) {
  print_err(render_text(source, diagnostic, context.err_style(), say_in(context.ui_language)));
}

bool print_findings(const Context& context, const Source& source,
                    const std::vector<Diagnostic>& findings) {
  bool errors = false;
  for (const auto& diagnostic : findings) {
    const bool error = is_error(diagnostic);
    errors = errors || error;
    if (error || (!context.quiet && diagnostic.severity == Severity::Warning) ||
        context.verbosity > 0)
      print_finding(context, source, diagnostic);
  }
  return errors;
}

bool print_findings(const Context& context, const std::vector<FileFindings>& files) {
  bool errors = false;
  for (const auto& file : files)
    errors = print_findings(context, *file.source, file.diagnostics) || errors;
  return errors;
}

tl::expected<void, Failure> check_inputs(const Context& context,
                                         const std::vector<run::Input>& inputs) {
  for (const auto& input : inputs)
    if (input.has_errors()) {
      print_findings(context, input.errors);
      return tl::unexpected(
          Failure{ExitCode::BadInput, fmt::format("{} has errors", input.source->name())});
    }
  return {};
}

} // namespace orb::cli
