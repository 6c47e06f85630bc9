#include "assembler/lint/lint.h"
#include "assembler/text/layout.h"
#include "assembler/text/rules.h"
#include "base/source.h"
#include "base/text/text.h"
#include "base/text/utf8.h"
#include "cli/commands/commands.h"
#include "cli/input/inputs.h"
#include "cli/terminal/diff.h"
#include "compiler/check.h"
#include "compiler/renumber.h"
#include "compiler/text/parse_basic.h"
#include "compiler/text/print.h"
#include "disk/disk.h"
#include "structured/layout/format.h"
#include "testing/suite.h"
#include "testing/text/layout.h"

#include <fmt/format.h>
#include <memory>
#include <optional>

namespace orb::cli {
namespace {

struct FmtOptions {
  std::vector<std::string> files;
  std::string lang;
  std::string renumber;
  bool renumbers = false;
  bool write = false;
  bool check = false;
  bool diff = false;
};

std::optional<std::uint32_t> read_number(std::string_view text) {
  const auto value = parse_number<std::uint16_t>(text);
  return value && *value > 0 ? std::optional<std::uint32_t>(*value) : std::nullopt;
}

/// `START:STEP`, or `START` alone.
std::optional<compiler::Numbering> read_numbering(const std::string& text) {
  if (text.empty())
    return compiler::Numbering{};
  const auto colon = text.find(':');
  const auto start = read_number(std::string_view(text).substr(0, colon));
  const auto step = colon == std::string::npos
                        ? std::optional<std::uint32_t>(compiler::Numbering{}.step)
                        : read_number(std::string_view(text).substr(colon + 1));
  if (!start || !step)
    return std::nullopt;
  return compiler::Numbering{*start, *step};
}

/// Returns the formatted text; nothing, with findings printed, if the file cannot be formatted.
std::optional<std::string> format_text(Context& context, const Source& source,
                                       const std::optional<compiler::Numbering>& numbering) {
  auto checked = compiler::check(source.text(), {});
  if (!checked.image_bytes) { // not a program: empty, binary or far too large
    for (const auto& diagnostic : checked.diagnostics)
      print_finding(context, source, diagnostic);
    context.exit = ExitCode::BadInput;
    return std::nullopt;
  }
  if (!numbering)
    return compiler::format(checked.program);
  const auto result = compiler::renumber(checked.program, *numbering);
  if (const auto* obstacle = std::get_if<compiler::Obstacle>(&result)) {
    const auto place = source.position(obstacle->span.begin);
    fail(context, {ExitCode::BadInput, fmt::format("{}:{}:{}: cannot renumber: {}", source.name(),
                                                   place.line, place.column, obstacle->message)});
    return std::nullopt;
  }
  const auto& text = std::get<std::string>(result);
  return compiler::format(compiler::parse(text));
}

/// The same with `layout`, for texts that are not parsed for it.
std::optional<std::string> lay_out(Context& context, const Source& source,
                                   std::string (*layout)(std::string_view)) {
  if (const auto refused = compiler::refuse_text(source.text())) {
    print_finding(context, source, *refused);
    context.exit = ExitCode::BadInput;
    return std::nullopt;
  }
  return layout(source.text());
}

/// The same for macro source; statements keep their order and comments.
std::optional<std::string> format_macro(Context& context, const Source& source) {
  namespace rules = assembler::rules;
  for (const auto& diagnostic : assembler::check(source))
    for (const auto* rule : {&rules::EmptyFile, &rules::BinaryFile, &rules::SourceTooLarge})
      if (diagnostic.rule == rule) {
        print_finding(context, source, diagnostic);
        context.exit = ExitCode::BadInput;
        return std::nullopt;
      }
  return assembler::layout(source.text());
}

bool is_for_tests(std::string_view name) {
  return has_ending(name, testing::file_ending) || has_ending(name, ".stimulus");
}

/// Writes, compares or prints the formatted text of a file.
void deliver(Context& context, const FmtOptions& options, const std::string& path,
             const Source& source, const std::string& formatted) {
  const bool changed = formatted != source.text();
  if (options.diff)
    print_out(unified_diff(source.name(), source.text(), formatted));
  if (options.check && changed) {
    print_note(context, fmt::format("{} would change", shown_name(source.name())));
    context.exit = ExitCode::BadInput;
  }
  if (options.write && changed) {
    if (const auto written = disk::write(path, as_bytes(formatted)); !written)
      fail(context, {ExitCode::File, written.error().message});
  }
  if (!options.diff && !options.check && !options.write)
    print_out(formatted);
}

void refuse_numbering(Context& context, const Source& source, std::string_view what) {
  fail(context, {ExitCode::Usage, fmt::format("{}: {} have no line numbers", source.name(), what)});
}

/// A test or a stimulus script.
void format_test(Context& context, const FmtOptions& options, const std::string& path) {
  const auto text = read_text(path);
  if (!text)
    return fail(context, text.error());
  const Source source(path, *text);
  if (options.renumbers)
    return refuse_numbering(context, source, "tests and stimulus scripts");
  if (const auto formatted = lay_out(context, source, testing::layout))
    deliver(context, options, path, source, *formatted);
}

void run_one(Context& context, const FmtOptions& options, const std::string& path,
             const std::optional<compiler::Numbering>& numbering) {
  if (options.lang.empty() && is_for_tests(path))
    return format_test(context, options, path);
  const auto file = read_source(path, options.lang);
  if (!file)
    return fail(context, file.error());
  const auto& source = file->source;
  if (file->language != run::Language::Basic && numbering)
    return refuse_numbering(
        context, source, file->language == run::Language::Macro ? "macros" : "structured programs");
  const auto formatted = [&] {
    switch (*file->language) {
    case run::Language::Basic: return format_text(context, source, numbering);
    case run::Language::Structured: return lay_out(context, source, structured::format);
    case run::Language::Macro: break;
    }
    return format_macro(context, source);
  }();
  if (!formatted)
    return;
  if (options.write && file->is_bytes)
    return fail(context, run::not_text(source.name()));
  deliver(context, options, path, source, *formatted);
}

void format_all(Context& context, const FmtOptions& options) {
  std::optional<compiler::Numbering> numbering;
  if (options.renumbers) {
    numbering = read_numbering(options.renumber);
    if (!numbering)
      return fail(context,
                  {ExitCode::Usage,
                   fmt::format("`--renumber={}` is not START:STEP, as in `--renumber=100:10`",
                               options.renumber)});
  }
  for (const auto& path : options.files)
    run_one(context, options, path, numbering);
}

} // namespace

void add_fmt(const Command& orb, Context& context) {
  const auto command = orb.add_command("fmt", "format programs, macros and tests",
                                       "orb fmt square.bas\n"
                                       "orb fmt -w *.bas *.orb *.test\n"
                                       "orb fmt --renumber=100:10 --diff square.bas");
  auto options = std::make_shared<FmtOptions>();
  command.add_option("FILE", options->files, "sources; `-` is standard input").required();
  add_language_option(command, options->lang);
  const auto write = command.add_flag("-w,--write", options->write, "write the files back");
  const auto check =
      command.add_flag("--check", options->check, "write nothing; exit 1 if a file would change");
  const auto diff = command.add_flag("--diff", options->diff, "print the change as a unified diff");
  write.excludes(check);
  write.excludes(diff);
  const auto renumber =
      command.add_option("--renumber", options->renumber,
                         "renumber the lines START, START+STEP…, and update every jump (10:10)");
  renumber.value_optional().type_name("START:STEP");
  command.callback([&context, options, renumber] {
    options->renumbers = renumber.given();
    format_all(context, *options);
  });
}

} // namespace orb::cli
