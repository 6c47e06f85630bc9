#include "base/render.h"
#include "cli/asm.h"
#include "cli/commands.h"
#include "cli/inputs.h"
#include "cli/target.h"
#include "compiler/check.h"
#include "compiler/image.h"
#include "compiler/rules.h"
#include "disk/disk.h"
#include "run/line_map.h"
#include "run/listing.h"

#include <algorithm>
#include <fmt/format.h>
#include <memory>

namespace orb::cli {
namespace {

struct Options {
  std::string file;
  std::string lang;
  std::string out = "-";
  std::string map;
  TargetOptions target;
  bool pack = false;
  bool no_check = false;
  bool listing = false;
  bool native = false;
};

/// Prints the errors; the size is left to the image that is really built.
bool has_errors(Context& context, const Source& source, const std::vector<Diagnostic>& found) {
  bool errors = false;
  for (const auto& diagnostic : found) {
    if (diagnostic.severity != Severity::Error ||
        diagnostic.rule == &compiler::rules::ProgramTooLarge)
      continue;
    errors = true;
    print_err(render_text(source, diagnostic, context.err_style()));
  }
  return errors;
}

bool write(Context& context, const std::string& path, std::string_view bytes) {
  if (path == "-") {
    print_out(bytes);
    return true;
  }
  const auto written = disk::write(path, as_bytes(bytes));
  if (!written)
    fail(context, {ExitCode::File, written.error().message});
  return written.has_value();
}

void build_basic(Context& context, const Options& options, const Source& source) {
  const auto target = options.target.target();
  const auto checked = compiler::check(source.text(), target);
  const bool refused = !checked.image_bytes;
  if ((refused || !options.no_check) && has_errors(context, source, checked.diagnostics)) {
    context.exit = ExitCode::BadInput;
    return;
  }
  const auto image = compiler::build_image(
      checked.program, options.pack ? compiler::Packing::Packed : compiler::Packing::Plain);
  const auto room = static_cast<std::size_t>(compiler::area_bytes(target));
  if (image.bytes.size() > room) {
    return fail(context,
                {ExitCode::BadInput,
                 fmt::format("{} takes {} bytes, {} more than the {} of the {} area{}",
                             source.name(), image.bytes.size(), image.bytes.size() - room, room,
                             options.target.area, options.pack ? "" : "; try `--pack`")});
  }
  if (!options.map.empty() &&
      !write(context, options.map, run::print_line_map(source.name(), image)))
    return;
  const auto listed = options.native ? run::Listed::MachineCode : run::Listed::Instructions;
  if (write(context, options.out, options.listing ? run::listing(image, listed) : image.bytes))
    print_note(context,
               fmt::format("{} of {} bytes ({})", image.bytes.size(), room, options.target.area));
}

void build(Context& context, const Options& options) {
  const auto file = read_source(options.file, options.lang);
  if (!file)
    return fail(context, file.error());
  if (file->language == run::Language::Basic)
    return build_basic(context, options, file->source);
  AsmOptions macros;
  macros.file = options.file;
  macros.out = options.out;
  macros.listing = options.listing;
  if (options.native)
    return fail(context, {ExitCode::Usage, "`--native` is for orbBasic; macros never become "
                                           "machine code"});
  context.exit = run_asm(context, macros);
}

} // namespace

void add_build(CLI::App& app, Context& context) {
  auto* command = add_command(app, "build", "make the exact bytes to upload",
                              "orb build square.bas -o square.img\n"
                              "orb build --pack square.bas --map square.json -o square.img\n"
                              "orb build --listing --native square.bas");
  auto options = std::make_shared<Options>();
  command->add_option("FILE", options->file, "a source; `-` is standard input")->required();
  add_language_option(*command, options->lang);
  command->add_option("-o,--output", options->out,
                      "where the bytes go; standard output if missing");
  command->add_flag("--pack", options->pack, "as small as it gets with the same behaviour");
  command->add_option("--map", options->map, "write which source line became which robot line");
  add_target_options(*command, options->target);
  command->add_flag("--no-check", options->no_check, "build although the program has errors");
  auto* listing = command->add_flag("--listing", options->listing,
                                    "in place of the bytes: each line and the instructions that "
                                    "the virtual ball makes of it");
  command->add_flag("--native", options->native, "list their machine code, too")->needs(listing);
  command->callback([&context, options] { build(context, *options); });
}

} // namespace orb::cli
