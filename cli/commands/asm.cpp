#include "cli/commands/asm.h"

#include "assembler/formats.h"
#include "assembler/lint/lint.h"
#include "cli/commands/commands.h"
#include "cli/context/console.h"
#include "cli/input/inputs.h"
#include "cli/model/checks.h"
#include "disk/disk.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <unistd.h>

namespace orb::cli {
namespace {

namespace fs = std::filesystem;

using assembler::Written;

bool to_stdout(const AsmOptions& options) {
  return options.out.empty() || options.out == "-";
}

/// The findings, and whether the bytes are of no use. What a macro does wrong while its bytes can
/// be sent is a warning here; `orb check` weighs it.
bool report(const Context& context, const Source& source, assembler::Assembly& assembly) {
  auto found = assembler::lint(source, assembly);
  bool fatal = assembly.has_errors();
  for (auto& diagnostic : found) {
    const bool blocks = assembler::cannot_be_sent(diagnostic);
    fatal = fatal || blocks;
    if (!blocks)
      diagnostic.severity = std::min(diagnostic.severity, Severity::Warning);
    assembly.diagnostics.push_back(std::move(diagnostic));
  }
  sort_by_place(assembly.diagnostics);
  for (const auto& diagnostic : assembly.diagnostics)
    if (diagnostic.severity == Severity::Error || !context.quiet)
      print_finding(context, source, diagnostic);
  return fatal;
}

ExitCode write_text(const Context& context, const std::string& path, const std::string& text) {
  if (path.empty()) {
    print_out(text);
    return ExitCode::Done;
  }
  const auto written = disk::write(path, as_bytes(text));
  if (written)
    return ExitCode::Done;
  print_error(context, written.error().message);
  return ExitCode::File;
}

/// Writes into the folder OUT a file for each macro.
ExitCode write_folder(const Context& context, const std::string& out, std::string_view ending,
                      const std::vector<Written>& macros) {
  std::error_code error;
  fs::create_directories(disk::as_path(out), error);
  if (error) {
    print_error(context, fmt::format("cannot create {}: {}", out, error.message()));
    return ExitCode::File;
  }
  for (const auto& macro : macros) {
    const auto path = disk::as_path(out) / disk::as_path(fmt::format("{}{}", macro.name, ending));
    const auto exit = write_text(context, path.generic_string(), macro.text);
    if (exit != ExitCode::Done)
      return exit;
    print_note(context, macro.size);
  }
  return ExitCode::Done;
}

/// Writes the macros in their format: into a folder, or the only one into a file or to stdout.
ExitCode write_macros(const Context& context, const AsmOptions& options,
                      const assembler::Format& format, const std::vector<Written>& macros) {
  if (!to_stdout(options) &&
      (options.out.ends_with('/') || fs::is_directory(disk::as_path(options.out))))
    return write_folder(context, options.out, format.endings.substr(0, format.endings.find(' ')),
                        macros);
  if (macros.size() > 1) {
    print_error(context,
                fmt::format("{} holds {} macros; pick one with `--macro {}`, or name a folder: "
                            "`-o DIR/`",
                            disk::display_name(options.file), macros.size(), macros[0].name));
    return ExitCode::Usage;
  }
  if (to_stdout(options) && format.is_binary && is_terminal(Stream::Out)) {
    print_error(context, "binary is not written to a terminal; add `-o FILE.sphero`, "
                         "`--format hex` or `--listing`");
    return ExitCode::Usage;
  }
  const auto exit = write_text(context, to_stdout(options) ? "" : options.out, macros[0].text);
  if (exit == ExitCode::Done)
    print_note(context, macros[0].size);
  return exit;
}

ExitCode write_listing(const Context& context, const AsmOptions& options,
                       const std::vector<Written>& macros) {
  std::string text;
  for (const auto& macro : macros)
    text += (text.empty() ? "" : "\n") + macro.text;
  return write_text(context, to_stdout(options) ? "" : options.out, text);
}

} // namespace

ExitCode run_asm(const Context& context, const AsmOptions& options) {
  auto text = disk::read(options.file);
  if (!text) {
    print_error(context, text.error().message);
    return ExitCode::File;
  }
  const Source source(disk::display_name(options.file), std::move(*text));
  auto assembly = assembler::assemble(source, options.fold_delays ? assembler::Folding::Fold
                                                                  : assembler::Folding::Keep);
  if (report(context, source, assembly))
    return ExitCode::BadInput;
  const auto& format =
      assembler::format_of(options.format, disk::as_path(options.out).extension().string());
  const auto macros =
      assembler::write(source, assembly,
                       {options.file == "-" ? "macro" : disk::as_path(options.file).stem().string(),
                        options.macro, options.listing ? nullptr : &format});
  if (!macros) {
    print_error(context, macros.error());
    return ExitCode::Usage;
  }
  return options.listing ? write_listing(context, options, *macros)
                         : write_macros(context, options, format, *macros);
}

void add_asm(const Command& orb, Context& context) {
  const auto command =
      orb.add_command("asm", "assemble macro source into bytes for the ball",
                      "orb asm dance.macro -o dance.sphero\norb asm dance.macro --listing\n"
                      "orb asm set.macro --format bin -o build/");
  auto options = std::make_shared<AsmOptions>();
  command.add_option("FILE", options->file, "macro source; - is stdin").required();
  command.add_option("-o,--out", options->out,
                     "where to write; a folder (with a trailing /) gets one file per macro");
  std::vector<std::string> names;
  for (const auto& format : assembler::formats)
    names.emplace_back(format.name);
  command
      .add_option("--format", options->format,
                  "output format; by default chosen by the extension of OUT, otherwise sphero")
      .check(one_of(names));
  command.add_option("--macro", options->macro, "write only this macro from the file");
  command.add_flag("--listing", options->listing,
                   "print offset, bytes, times and source instead of the bytes alone");
  command.add_flag("--fold-delays", options->fold_delays,
                   "fold `delay` into the command before it where all times stay the same");
  command.callback([&context, options] { context.exit = run_asm(context, *options); });
}

} // namespace orb::cli
