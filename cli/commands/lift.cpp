#include "structured/lift/lift.h"

#include "cli/commands/commands.h"
#include "cli/input/inputs.h"
#include "disk/disk.h"

#include <fmt/format.h>
#include <memory>

namespace orb::cli {
namespace {

struct LiftOptions {
  std::string file;
  std::string out = "-";
};

void lift(Context& context, const LiftOptions& options) {
  const auto language = run::language_of(options.file, "").value_or(run::Language::Basic);
  if (language != run::Language::Basic)
    return fail(context,
                {ExitCode::Usage,
                 fmt::format("{} is {}; `orb lift` takes programs with line numbers (`.bas`)",
                             disk::display_name(options.file),
                             language == run::Language::Macro ? "a macro" : "already structured")});
  const auto file = read_source(options.file, "basic");
  if (!file)
    return fail(context, file.error());
  const auto& source = file->source;
  const auto lifted = structured::lift(compiler::check(source.text(), {}));
  if (print_findings(context, source, lifted.findings)) {
    context.exit = ExitCode::BadInput;
    return;
  }
  if (const auto written = disk::write(options.out, as_bytes(lifted.text)); !written)
    fail(context, {ExitCode::File, written.error().message});
}

} // namespace

void add_lift(const Command& orb, Context& context) {
  const auto command = orb.add_command("lift", "turn a numbered program into a structured one",
                                       "orb lift maze.bas -o maze.orb\n"
                                       "orb lift maze.bas | less");
  auto options = std::make_shared<LiftOptions>();
  command.add_option("FILE", options->file, "a numbered program; `-` is standard input").required();
  command.add_option("-o,--output", options->out,
                     "where to write the structured program; standard output if omitted");
  command.callback([&context, options] { lift(context, *options); });
}

} // namespace orb::cli
