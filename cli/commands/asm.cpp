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

/// Where to write macros.
struct Destination {
  std::string path; ///< empty: stdout
  bool is_folder = false;
  std::string ending; ///< file extension
};

Destination destination_of(const std::string& out) {
  if (out.empty() || out == "-")
    return {};
  const auto path = disk::as_path(out);
  return {out, out.ends_with('/') || fs::is_directory(path), path.extension().string()};
}

/// Prints the findings. Returns true if the bytes are useless. A mistake that still gives bytes to
/// send is a warning here; `orb check` decides how severe it is.
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

/// A file to write; standard output if it has no path.
struct Output {
  std::string path;
  std::string text;
  std::string note; ///< printed once it is written
};

using Outputs = tl::expected<std::vector<Output>, Failure>;

Outputs misuse(std::string message) {
  return tl::unexpected(Failure{ExitCode::Usage, std::move(message)});
}

/// One file in a folder for each macro.
std::vector<Output> in_folder(const std::string& folder, const std::vector<Written>& macros) {
  std::vector<Output> outputs;
  for (const auto& macro : macros) {
    const auto path = disk::as_path(folder) / disk::as_path(macro.file_name);
    outputs.push_back({path.generic_string(), macro.text, macro.size});
  }
  return outputs;
}

/// Decides where the macros of a source go: a folder, or, for a single one, a file or stdout.
Outputs outputs_of(const Source& source, const std::vector<Written>& macros,
                   const Destination& destination) {
  if (destination.is_folder)
    return in_folder(destination.path, macros);
  if (macros.size() > 1)
    return misuse(fmt::format("{} holds {} macros; pick one with `--macro {}`, or name a folder: "
                              "`-o DIR/`",
                              source.name(), macros.size(), macros[0].name));
  if (destination.path.empty() && macros[0].is_binary && is_terminal(Stream::Out))
    return misuse("binary is not written to a terminal; add `-o FILE.sphero`, `--format hex` or "
                  "`--listing`");
  return std::vector<Output>{{destination.path, macros[0].text, macros[0].size}};
}

/// The listings of all macros, concatenated.
Output listing_of(const std::vector<Written>& macros, const std::string& path) {
  Output output{path, {}, {}};
  for (const auto& macro : macros)
    output.text += (output.text.empty() ? "" : "\n") + macro.text;
  return output;
}

tl::expected<void, Failure> write(const Context& context, const Output& output) {
  if (output.path.empty()) {
    print_out(output.text);
  } else if (const auto written = disk::write(output.path, as_bytes(output.text)); !written) {
    return tl::unexpected(Failure{ExitCode::File, written.error().message});
  }
  if (!output.note.empty())
    print_note(context, output.note);
  return {};
}

tl::expected<void, Failure> make_folder(const std::string& path) {
  std::error_code error;
  fs::create_directories(disk::as_path(path), error);
  if (error)
    return tl::unexpected(
        Failure{ExitCode::File, fmt::format("cannot create {}: {}", path, error.message())});
  return {};
}

} // namespace

void run_asm(Context& context, const std::string& file, const AsmWay& way, const std::string& out) {
  const auto destination = destination_of(out);
  const auto stem = file == "-" ? std::string("macro") : disk::as_path(file).stem().string();
  auto text = disk::read(file);
  if (!text)
    return fail(context, {ExitCode::File, text.error().message});
  const auto name = disk::display_name(file);
  if (run::holds_macro_bytes(file)) {
    auto made = run::macro_source(name, *text);
    if (!made)
      return fail(context, made.error());
    text = *std::move(made);
  }
  const Source source(name, std::move(*text));
  auto assembly = assembler::assemble(source, way.fold_delays ? assembler::Folding::Fold
                                                              : assembler::Folding::Keep);
  if (report(context, source, assembly)) {
    context.exit = ExitCode::BadInput;
    return;
  }
  const auto macros = assembler::write(
      source, assembly, {stem, way.macro, way.format, destination.ending, way.listing});
  if (!macros)
    return fail(context, {ExitCode::Usage, macros.error()});
  const auto outputs = way.listing ? Outputs({listing_of(*macros, destination.path)})
                                   : outputs_of(source, *macros, destination);
  if (!outputs)
    return fail(context, outputs.error());
  if (!way.listing && destination.is_folder)
    if (const auto made = make_folder(destination.path); !made)
      return fail(context, made.error());
  for (const auto& output : *outputs)
    if (const auto written = write(context, output); !written)
      return fail(context, written.error());
}

void add_asm(const Command& orb, Context& context) {
  const auto command =
      orb.add_command("asm", "assemble macro source into bytes for the ball",
                      "orb asm dance.macro -o dance.sphero\norb asm dance.macro --listing\n"
                      "orb asm set.macro --format bin -o build/");
  struct Options {
    std::string file;
    AsmWay way;
    std::string out;
  };
  auto options = std::make_shared<Options>();
  command.add_option("FILE", options->file, "macro source; - is stdin").required();
  command.add_option("-o,--out", options->out,
                     "where to write; a folder (with a trailing /) gets one file per macro");
  std::vector<std::string> names;
  for (const auto& format : assembler::formats)
    names.emplace_back(format.name);
  command
      .add_option("--format", options->way.format,
                  "output format; by default chosen by the extension of OUT, otherwise sphero")
      .check(one_of(names));
  command.add_option("--macro", options->way.macro, "write only this macro from the file");
  command.add_flag("--listing", options->way.listing,
                   "print offset, bytes, times and source instead of the bytes alone");
  command.add_flag("--fold-delays", options->way.fold_delays,
                   "fold `delay` into the command before it where all times stay the same");
  command.callback(
      [&context, options] { run_asm(context, options->file, options->way, options->out); });
}

} // namespace orb::cli
