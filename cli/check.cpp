#include "compiler/check.h"
#include "assembler/lint.h"
#include "base/fixes.h"
#include "base/render.h"
#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/options.h"
#include "cli/policy.h"
#include "cli/target.h"
#include "cli/watch.h"
#include "disk/disk.h"
#include "reference/knowledge.h"
#include "testing/suite.h"

#include <algorithm>
#include <deque>
#include <fmt/format.h>
#include <memory>
#include <unistd.h>

namespace orb::cli {
namespace {

struct Options {
  std::vector<std::string> files;
  std::string lang;
  std::string format = "text";
  TargetOptions target;
  Policy policy;
  assembler::LintOptions macro;
  bool fix = false;
  bool watch = false;
};

using run::Language;

/// Sources are referred to and must not move.
using Sources = std::deque<SourceFile>;

/// Whether a file is something else than a program or a macro: a course or tests.
bool is_no_program(const std::string& path) {
  return report::is_course(path) || testing::is_test(path);
}

std::vector<Diagnostic> check_other(const SourceFile& input) {
  if (report::is_course(input.path))
    return report::read_course(input.source).findings;
  DiskFiles disk;
  return testing::check(input.source, disk);
}

tl::expected<Sources, Failure> read_sources(const Options& options) {
  Sources sources;
  for (const auto& path : options.files) {
    if (is_no_program(path)) {
      auto text = read_text(path);
      if (!text)
        return tl::unexpected(text.error());
      sources.push_back({path, Language::Basic, // of no language; is_no_program() comes first
                         Source(disk::display_name(path), *std::move(text))});
      continue;
    }
    auto source = read_source(path, options.lang);
    if (!source)
      return tl::unexpected(source.error());
    sources.push_back(*std::move(source));
  }
  return sources;
}

/// The sources of what programs include, which findings refer to.
using IncludedSources = std::deque<Source>;

FileFindings check_basic(const Options& options, const Source& source) {
  FileFindings findings;
  findings.source = &source;
  auto checked = compiler::check(source.text(), options.target.target());
  findings.diagnostics = std::move(checked.diagnostics);
  findings.built_size = checked.image_bytes;
  return findings;
}

/// A structured program, and after it each included file that something is said about.
std::vector<FileFindings> check_structured(const Options& options, const Source& source,
                                           IncludedSources& included) {
  DiskFiles disk;
  const auto compiled = structured::compile(source.name(), source.name(), source.text(),
                                            options.target.target(), disk);
  auto found = structured::findings_by_file(compiled.program);
  std::vector<FileFindings> files;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (i > 0 && found[i].empty())
      continue;
    const auto& file = compiled.program.files[i];
    if (i > 0)
      included.emplace_back(file.name,
                            compiled.program.text.substr(file.begin, file.end - file.begin));
    files.push_back({i == 0 ? &source : &included.back(), std::move(found[i]), {}});
  }
  if (!compiled.robot.lines.empty())
    files.front().built_size = compiled.image_bytes;
  return files;
}

/// Whether an included file is checked for its own sake, or was shown already.
bool is_told(const std::vector<FileFindings>& files, const Sources& inputs, const SourceFile& main,
             const FileFindings& file) {
  const auto& name = file.source->name();
  return file.source != &main.source &&
         (std::any_of(inputs.begin(), inputs.end(),
                      [&](const SourceFile& input) { return input.source.name() == name; }) ||
          std::any_of(files.begin(), files.end(),
                      [&](const FileFindings& other) { return other.source->name() == name; }));
}

/// Checks all files. Macros are checked together: they go to one ball and call each other.
std::vector<FileFindings> check_all(const Options& options, const Sources& inputs,
                                    IncludedSources& included) {
  std::vector<const Source*> macros;
  for (const auto& input : inputs)
    if (input.language == Language::Macro)
      macros.push_back(&input.source);
  auto of_macros = assembler::check(macros, options.macro);
  std::vector<FileFindings> files;
  std::size_t next_macro = 0;
  for (const auto& input : inputs) {
    if (is_no_program(input.path)) {
      files.push_back({&input.source, check_other(input), {}});
      continue;
    }
    switch (input.language) {
    case Language::Basic: files.push_back(check_basic(options, input.source)); break;
    case Language::Structured:
      for (auto& file : check_structured(options, input.source, included))
        if (!is_told(files, inputs, input, file))
          files.push_back(std::move(file));
      break;
    case Language::Macro: files.push_back(std::move(of_macros[next_macro++])); break;
    }
  }
  for (auto& file : files)
    weigh(options.policy, file.diagnostics);
  return files;
}

std::vector<Diagnostic> findings_of(const Options& options, const SourceFile& input) {
  IncludedSources included;
  auto found = [&] {
    if (is_no_program(input.path))
      return check_other(input);
    switch (input.language) {
    case Language::Basic: return check_basic(options, input.source).diagnostics;
    case Language::Structured:
      return std::move(check_structured(options, input.source, included).front().diagnostics);
    case Language::Macro: break;
    }
    return assembler::check(input.source, options.macro);
  }();
  weigh(options.policy, found);
  return found;
}

/// Makes the safe fixes of a file until none is left, and writes it back where one was made.
bool fix_one(Context& context, const Options& options, SourceFile& input) {
  constexpr int most_rounds = 64; // one mistake hides the next on its line; no fix undoes another
  std::size_t made = 0;
  for (int round = 0; round < most_rounds; ++round) {
    auto fixed = apply_fixes(input.source.text(), findings_of(options, input));
    if (fixed.count == 0)
      break;
    made += fixed.count;
    input.source = Source(input.source.name(), std::move(fixed.text));
  }
  if (made == 0)
    return true;
  if (const auto written = disk::write(input.path, as_bytes(input.source.text())); !written) {
    fail(context, {ExitCode::File, written.error().message});
    return false;
  }
  print_note(context,
             fmt::format("{}: {} fix{} made", input.source.name(), made, made == 1 ? "" : "es"));
  return true;
}

/// The part of the documentation that explains a rule, as it was installed.
std::string page_of(const std::vector<reference::Section>& sections, const Rule& rule) {
  for (const auto& section : sections)
    for (const auto& entry : section.entries)
      if (entry.name == rule.id)
        return fmt::format("{}/reference/{}.md#{}", ORB_DOCS, section.id, rule.id);
  return {};
}

void print_findings(Context& context, const Options& options,
                    const std::vector<FileFindings>& files) {
  if (options.format == "json") {
    print_out(render_json(files));
  } else if (options.format == "sarif") {
    const auto sections = reference::knowledge();
    print_out(render_sarif(files, [&](const Rule& rule) { return page_of(sections, rule); }));
  } else {
    const auto style = context.out_style();
    std::string out;
    for (const auto& file : files)
      for (const auto& diagnostic : file.diagnostics)
        out += options.format == "gcc" ? render_gcc(*file.source, diagnostic)
                                       : render_text(*file.source, diagnostic, style);
    print_out(out);
    if (options.format == "text" && ::isatty(STDOUT_FILENO) != 0)
      print_out(render_summary(files));
  }
}

void check(Context& context, const Options& options) {
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
  IncludedSources included;
  auto files = check_all(options, *inputs, included);
  if (count(files).errors > 0)
    context.exit = ExitCode::BadInput;
  const auto hidden = cut(options.policy, files);
  print_findings(context, options, files);
  if (hidden > 0)
    print_note(context, fmt::format("{} more finding{} not shown; `--max-errors 0` shows all",
                                    hidden, hidden == 1 ? " is" : "s are"));
}

} // namespace

void add_check(CLI::App& app, Context& context) {
  auto* command =
      add_command(app, "check", "find the mistakes in programs, macros, courses and tests",
                  "orb check square.bas\n"
                  "orb check --target 1.2 --ram 1024 *.bas\n"
                  "orb check --fix patrol.orb\n"
                  "orb check parking.svg\n"
                  "orb check --watch square.bas\n"
                  "orb check --format sarif *.bas *.macro > findings.sarif");
  auto options = std::make_shared<Options>();
  command->add_option("FILE", options->files, "sources; `-` is standard input")->required();
  add_language_option(*command, options->lang);
  add_target_options(*command, options->target);
  command
      ->add_option("--executive", options->macro.executive,
                   "version of the ball's macro executive, for macro source")
      ->check(whole_number(spec::macro_executive_oldest, spec::macro_executive_newest))
      ->capture_default_str();
  command->add_option("--format", options->format, "how findings are printed")
      ->check(one_of({"text", "json", "sarif", "gcc"}))
      ->capture_default_str();
  add_policy_options(*command, options->policy);
  command->add_flag("--fix", options->fix, "make the safe fixes and write the files back");
  command->add_flag("--watch", options->watch, "check again whenever a file changes");
  command->callback([&context, options] {
    if (options->watch)
      watch(
          context, [&] { return files_of(options->files, options->lang); },
          [&] { check(context, *options); });
    else
      check(context, *options);
  });
}

} // namespace orb::cli
