#include "cli/commands/asm.h"

#include "assembler/formats.h"
#include "assembler/lint.h"
#include "assembler/timing.h"
#include "base/suggest.h"
#include "base/text.h"
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

using assembler::Assembly;

struct Format {
  std::string_view name;
  std::string_view endings; ///< of files, each with its dot, blank between
  bool is_binary = false;
};

constexpr Format formats[] = {{"sphero", ".sphero", true},
                              {"bin", ".bin", true},
                              {"hex", ".hex", false},
                              {"c", ".c .h .inc", false},
                              {"json", ".json", false}};

const Format& format_of(const AsmOptions& options) {
  for (const auto& format : formats)
    if (format.name == options.format)
      return format;
  const auto ending = disk::as_path(options.out).extension().string();
  for (const auto& format : formats)
    if (!ending.empty() &&
        (std::string(format.endings) + " ").find(ending + " ") != std::string::npos)
      return format;
  return formats[0];
}

bool to_stdout(const AsmOptions& options) {
  return options.out.empty() || options.out == "-";
}

std::string macro_name(const AsmOptions& options, const assembler::AssembledMacro& macro) {
  if (!macro.name.empty())
    return macro.name;
  return options.file == "-" ? "macro" : disk::as_path(options.file).stem().string();
}

std::string print(const Format& format, const std::string& name, const Source& source,
                  const Assembly& assembly, std::size_t index) {
  const auto& macro = assembly.macros[index];
  if (format.name == "sphero")
    return std::string(as_text(macro.body));
  if (format.name == "bin")
    return std::string(as_text(protocol::encode(macro.image())));
  if (format.name == "hex")
    return to_hex(protocol::encode(macro.image())) + "\n";
  if (format.name == "c")
    return print_c(name, macro);
  return print_macro_json(name, source, assembly, index);
}

/// The findings, and whether the bytes are of no use. What a macro does wrong while its bytes can
/// be sent is a warning here; `orb check` weighs it.
bool report(const Context& context, const Source& source, Assembly& assembly) {
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

/// The macros to write: all, or the one that the user named.
tl::expected<std::vector<std::size_t>, std::string> choose_macros(const AsmOptions& options,
                                                                  const Assembly& assembly) {
  std::vector<std::size_t> all;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < assembly.macros.size(); ++i) {
    names.push_back(macro_name(options, assembly.macros[i]));
    if (options.macro.empty() || options.macro == names.back())
      all.push_back(i);
  }
  if (!all.empty())
    return all;
  return tl::unexpected(fmt::format(
      "{} has no macro `{}`; {}", disk::display_name(options.file), options.macro,
      did_you_mean(options.macro, names, fmt::format("it has {}", fmt::join(names, ", ")))));
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

void add_note(const Context& context, const AsmOptions& options, const Assembly& assembly,
              std::size_t index) {
  const auto& macro = assembly.macros[index];
  print_note(context,
             fmt::format("{}: {}, {} ({} with id and flags), {}", macro_name(options, macro),
                         plural(macro.commands.size(), "command"),
                         plural(macro.body.size(), "byte"), macro.framed_size(),
                         assembler::to_string(assembler::time_macro(assembly, index))));
}

ExitCode write_all(const Context& context, const AsmOptions& options, const Source& source,
                   const Assembly& assembly, const std::vector<std::size_t>& macros) {
  const auto& format = format_of(options);
  const bool folder = !to_stdout(options) &&
                      (options.out.ends_with('/') || fs::is_directory(disk::as_path(options.out)));
  if (macros.size() > 1 && !folder) {
    print_error(context,
                fmt::format("{} holds {} macros; pick one with `--macro {}`, or name a folder: "
                            "`-o DIR/`",
                            disk::display_name(options.file), macros.size(),
                            macro_name(options, assembly.macros[macros[0]])));
    return ExitCode::Usage;
  }
  if (to_stdout(options) && format.is_binary && is_terminal(Stream::Out)) {
    print_error(context, "binary is not written to a terminal; add `-o FILE.sphero`, "
                         "`--format hex` or `--listing`");
    return ExitCode::Usage;
  }
  if (folder) {
    std::error_code error;
    fs::create_directories(disk::as_path(options.out), error);
    if (error) {
      print_error(context, fmt::format("cannot create {}: {}", options.out, error.message()));
      return ExitCode::File;
    }
  }
  const auto ending = format.endings.substr(0, format.endings.find(' '));
  for (const auto index : macros) {
    const auto name = macro_name(options, assembly.macros[index]);
    const auto path =
        folder ? (disk::as_path(options.out) / disk::as_path(fmt::format("{}{}", name, ending)))
                     .generic_string()
        : to_stdout(options) ? std::string()
                             : options.out;
    const auto exit = write_text(context, path, print(format, name, source, assembly, index));
    if (exit != ExitCode::Done)
      return exit;
    add_note(context, options, assembly, index);
  }
  return ExitCode::Done;
}

ExitCode write_listing(const Context& context, const AsmOptions& options, const Source& source,
                       const Assembly& assembly, const std::vector<std::size_t>& macros) {
  std::string text;
  for (const auto index : macros)
    text += (text.empty() ? "" : "\n") +
            print_listing(macro_name(options, assembly.macros[index]), source, assembly, index);
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
  const auto macros = choose_macros(options, assembly);
  if (!macros) {
    print_error(context, macros.error());
    return ExitCode::Usage;
  }
  return options.listing ? write_listing(context, options, source, assembly, *macros)
                         : write_all(context, options, source, assembly, *macros);
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
  for (const auto& format : formats)
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
