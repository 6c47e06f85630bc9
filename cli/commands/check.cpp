#include "assembler/lint/lint.h"
#include "base/render.h"
#include "base/text/utf8.h"
#include "cli/commands/commands.h"
#include "cli/context/console.h"
#include "cli/context/language.h"
#include "cli/input/inputs.h"
#include "cli/input/policy.h"
#include "cli/input/target.h"
#include "cli/model/checks.h"
#include "cli/room/room_plan.h"
#include "cli/room/run_together.h"
#include "cli/terminal/watch.h"
#include "disk/disk.h"
#include "reference/knowledge.h"
#include "run/check_files.h"
#include "testing/suite.h"

#include <algorithm>
#include <fmt/format.h>
#include <memory>
#include <span>

namespace orb::cli {
namespace {

struct CheckOptions {
  std::vector<std::string> files;
  std::string lang;
  std::string format = "text";
  TargetOptions target;
  std::string robot; ///< the robot that drives; empty for any
  Policy policy;
  assembler::LintOptions macro;
  bool fix = false;
  bool explain_repairs = false;
  bool watch = false;
};

using run::SourceFile;

using Sources = std::vector<SourceFile>;

tl::expected<Sources, Failure> read_sources(const CheckOptions& options) {
  Sources sources;
  for (const auto& path : options.files) {
    if (testing::is_no_program(path)) {
      auto text = read_text(path);
      if (!text)
        return tl::unexpected(text.error());
      sources.push_back({path, {}, Source(disk::display_name(path), *std::move(text))});
      continue;
    }
    auto source = read_source(path, options.lang);
    if (!source)
      return tl::unexpected(source.error());
    sources.push_back(*std::move(source));
  }
  return sources;
}

run::Findings check_all(const CheckOptions& options, std::span<const SourceFile> sources) {
  DiskFiles disk;
  auto target = options.target.target();
  auto macro = options.macro;
  if (!options.robot.empty())
    // the options have been checked
    target.robot = macro.robot = spec::find_robot(options.robot)->robot;
  auto found = run::check_files(sources, target, macro, disk);
  testing::check_tests(sources, found.files, disk);
  for (auto& file : found.files)
    weigh(options.policy, file.diagnostics);
  return found;
}

/// Applies the safe fixes of a file until none is left; writes the file back if any was applied.
bool fix_one(Context& context, const CheckOptions& options, SourceFile& input) {
  const auto made = run::fix(input, [&](const SourceFile& file) {
    return check_all(options, {&file, 1}).files.front().diagnostics;
  });
  if (made == 0)
    return true;
  if (input.is_bytes) {
    fail(context, run::not_text(input.source.name()));
    return false;
  }
  if (const auto written = disk::write(input.path, as_bytes(input.source.text())); !written) {
    fail(context, {ExitCode::File, written.error().message});
    return false;
  }
  print_note(context,
             fmt::format("{}: {} fix{} applied", input.source.name(), made, made == 1 ? "" : "es"));
  return true;
}

/// The installed documentation page section that explains a rule.
std::string page_of(const std::vector<reference::Section>& sections, const Rule& rule) {
  for (const auto& section : sections)
    for (const auto& entry : section.entries)
      if (entry.name == rule.id)
        return fmt::format("{}/reference/{}.md#{}", ORB_DOCS, section.id, rule.id);
  return {};
}

std::string_view effect_of(const Considered& one) {
  switch (one.effect) {
  case Considered::Effect::Worse: return "no better";
  case Considered::Effect::Parses: return "parses";
  case Considered::Effect::Mends: return "mends";
  }
  return {};
}

/// Lists the candidate lines in the order tried: the result of each, the step that proposed it, and
/// its cost.
std::string render_repairs(const Diagnostic& finding) {
  std::string out;
  for (const auto& one : finding.considered)
    out += fmt::format("  tried: `{}`: {} ({}, cost {})\n", to_printable(one.line), effect_of(one),
                       one.origin, one.cost);
  return out;
}

void print_findings(Context& context, const CheckOptions& options,
                    const std::vector<FileFindings>& files) {
  if (options.format == "json") {
    print_out(render_json(files));
  } else if (options.format == "sarif") {
    const auto sections = reference::knowledge();
    print_out(render_sarif(files, [&](const Rule& rule) { return page_of(sections, rule); }));
  } else {
    const auto style = context.out_style();
    const auto say = say_in(context.ui_language);
    std::string out;
    for (const auto& file : files)
      for (const auto& diagnostic : file.diagnostics) {
        out += options.format == "gcc" ? render_gcc(*file.source, diagnostic)
                                       : render_text(*file.source, diagnostic, style, say);
        if (options.explain_repairs)
          out += render_repairs(diagnostic);
      }
    print_out(out);
    if (options.format == "text" && is_terminal(Stream::Out))
      print_out(render_summary(files, say));
  }
}

void check(Context& context, const CheckOptions& given) {
  auto options = given;
  auto opened = open_rooms(given.files);
  if (!opened)
    return fail(context, opened.error());
  options.files = *std::move(opened);
  if (!check_rules(context, options.policy))
    return;
  if (options.fix &&
      std::find(options.files.begin(), options.files.end(), "-") != options.files.end()) {
    return fail(context,
                {ExitCode::Usage, "`--fix` writes files back; standard input is not a file"});
  }
  auto inputs = read_sources(options);
  if (!inputs)
    return fail(context, inputs.error());
  for (auto& input : *inputs)
    if (options.fix && !fix_one(context, options, input))
      return;
  auto found = check_all(options, *inputs);
  auto& files = found.files;
  if (count(files).errors > 0)
    context.exit = ExitCode::BadInput;
  const auto hidden = cut(options.policy, files);
  print_findings(context, options, files);
  if (context.exit == ExitCode::Done)
    for (const auto& file : given.files)
      if (is_room_file(file))
        if (const auto good = check_room(context, file); !good)
          return fail(context, good.error());
  if (hidden > 0)
    print_note(context, fmt::format("{} more finding{} not shown; `--max-errors 0` shows all",
                                    hidden, hidden == 1 ? " is" : "s are"));
}

} // namespace

void add_check(const Command& orb, Context& context) {
  const auto command =
      orb.add_command("check", "find mistakes in programs, macros, courses, rooms and tests",
                      "orb check square.bas\n"
                      "orb check --target 1.2 --ram 1024 *.bas\n"
                      "orb check --robot rvr patrol.orb\n"
                      "orb check --fix patrol.orb\n"
                      "orb check parking.svg\n"
                      "orb check --watch square.bas\n"
                      "orb check --format sarif *.bas *.macro > findings.sarif");
  auto options = std::make_shared<CheckOptions>();
  command.add_option("FILE", options->files, "sources; `-` is standard input").required();
  add_language_option(command, options->lang);
  add_target_options(command, options->target);
  command.add_option("--robot", options->robot, "the robot model; anything it lacks is a finding")
      .check(one_of(names_of(spec::robots)));
  command
      .add_option("--executive", options->macro.executive,
                  "version of the ball's macro executive, for macro source")
      .check(whole_number(spec::macro_executive_oldest, spec::macro_executive_newest))
      .show_default();
  command.add_option("--format", options->format, "how findings are printed")
      .check(one_of({"text", "json", "sarif", "gcc"}))
      .show_default();
  add_policy_options(command, options->policy);
  command.add_flag("--fix", options->fix, "apply the safe fixes and write the files back");
  command.add_flag("--explain-repairs", options->explain_repairs,
                   "print the candidates that were tried for the suggested line");
  command.add_flag("--watch", options->watch, "check again whenever a file changes");
  command.callback([&context, options] {
    if (options->watch)
      watch(
          context, [&] { return files_of(options->files, options->lang); },
          [&] { check(context, *options); });
    else
      check(context, *options);
  });
}

} // namespace orb::cli
