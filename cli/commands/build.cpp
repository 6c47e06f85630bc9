#include "cli/commands/asm.h"
#include "cli/commands/commands.h"
#include "cli/input/inputs.h"
#include "cli/input/target.h"
#include "compiler/check.h"
#include "compiler/text/image.h"
#include "compiler/text/parse_basic.h"
#include "compiler/text/rules.h"
#include "disk/disk.h"
#include "run/line_map.h"
#include "run/listing.h"
#include "structured/emit/listing.h"

#include <algorithm>
#include <fmt/format.h>
#include <memory>

namespace orb::cli {
namespace {

struct BuildOptions {
  std::string file;
  std::string lang;
  std::string out = "-";
  std::string map;
  TargetOptions target;
  bool pack = false;
  bool readable = false;
  bool no_check = false;
  bool listing = false;
  bool native = false;
};

/// Prints the errors. Findings about size are left to the image that is actually built.
bool has_errors(Context& context, const Source& source, const std::vector<Diagnostic>& found) {
  bool errors = false;
  for (const auto& diagnostic : found) {
    if (!keeps_from_building(diagnostic) || diagnostic.rule == &compiler::rules::ProgramTooLarge)
      continue;
    errors = true;
    print_finding(context, source, diagnostic);
  }
  return errors;
}

bool write_bytes(Context& context, const std::string& path, std::string_view bytes) {
  if (path == "-") {
    print_out(bytes);
    return true;
  }
  const auto written = disk::write(path, as_bytes(bytes));
  if (!written)
    fail(context, {ExitCode::File, written.error().message});
  return written.has_value();
}

void build_basic(Context& context, const BuildOptions& options, const Source& source) {
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
                 fmt::format("{} takes {} bytes, {} more than the {} in the {} area{}",
                             source.name(), image.bytes.size(), image.bytes.size() - room, room,
                             options.target.area, options.pack ? "" : "; try `--pack`")});
  }
  if (!options.map.empty() &&
      !write_bytes(context, options.map,
                   run::print_line_map(run::line_map(source.name(), image), image)))
    return;
  const auto listed = options.native ? run::Listed::MachineCode : run::Listed::Instructions;
  if (write_bytes(context, options.out,
                  options.listing ? run::listing(image, listed) : image.bytes))
    print_note(context,
               fmt::format("{} of {} bytes ({})", image.bytes.size(), room, options.target.area));
}

void build_structured(Context& context, const BuildOptions& options, const Source& source) {
  const auto target = options.target.target();
  DiskFiles files;
  const auto input =
      run::read_input(source.name(), std::string(source.text()), "structured", target, files);
  if (!input)
    return fail(context, input.error());
  if (print_findings(context, input->errors)) {
    context.exit = ExitCode::BadInput;
    return;
  }
  const auto& program = *input->program;
  if (!options.map.empty() &&
      !write_bytes(context, options.map, run::print_line_map(program.lines, program.image)))
    return;
  const auto text = options.readable  ? structured::readable(*program.compiled)
                    : options.native  ? run::listing(program.image, run::Listed::MachineCode)
                    : options.listing ? structured::listing(*program.compiled, program.image)
                                      : program.image.bytes;
  if (!write_bytes(context, options.out, text))
    return;
  const auto room = static_cast<std::size_t>(compiler::area_bytes(target));
  print_note(context, fmt::format("{} of {} bytes ({})", program.image.bytes.size(), room,
                                  options.target.area));
  if (!options.readable)
    return;
  // Line numbers in steps of ten take more bytes than those in steps of one.
  const auto bytes_as = [&](compiler::Packing packing) {
    return compiler::build_image(compiler::parse(text), packing).bytes.size();
  };
  const auto plain = bytes_as(compiler::Packing::Plain);
  const auto packed = bytes_as(compiler::Packing::Packed);
  const auto note = [&](std::size_t bytes, const std::string& way_out) {
    print_note(context, fmt::format("the readable text takes {} bytes, {} more than the {} area "
                                    "holds; {}",
                                    bytes, bytes - room, options.target.area, way_out));
  };
  if (packed > room)
    note(packed, fmt::format("upload {} itself", source.name()));
  else if (plain > room)
    note(plain, fmt::format("`orb build --pack` reduces it to {}", packed));
}

void build(Context& context, const BuildOptions& options) {
  const auto file = read_source(options.file, options.lang);
  if (!file)
    return fail(context, file.error());
  if (file->language == run::Language::Structured)
    return build_structured(context, options, file->source);
  if (options.readable)
    return fail(context,
                {ExitCode::Usage,
                 fmt::format("`--readable` is for structured programs (.orb); {} is not one",
                             file->source.name())});
  if (file->language == run::Language::Basic)
    return build_basic(context, options, file->source);
  if (options.native)
    return fail(context, {ExitCode::Usage, "`--native` is for orbBasic; macros never become "
                                           "machine code"});
  AsmWay way;
  way.listing = options.listing;
  run_asm(context, options.file, way, options.out);
}

} // namespace

void add_build(const Command& orb, Context& context) {
  const auto command =
      orb.add_command("build", "build the exact bytes to upload",
                      "orb build square.bas -o square.img\n"
                      "orb build --pack square.bas --map square.json -o square.img\n"
                      "orb build patrol.orb --readable -o patrol.bas\n"
                      "orb build --listing --native square.bas");
  auto options = std::make_shared<BuildOptions>();
  command.add_option("FILE", options->file, "a source; `-` is standard input").required();
  add_language_option(command, options->lang);
  command.add_option("-o,--output", options->out,
                     "where to write the bytes; standard output if omitted");
  command.add_flag("--pack", options->pack,
                   "make the program as small as possible without changing its behaviour; "
                   "structured programs are always packed");
  const auto map =
      command.add_option("--map", options->map, "write a map from source lines to robot lines");
  const auto readable =
      command.add_flag("--readable", options->readable,
                       "for a structured program: readable orbBasic, with comments");
  readable.excludes(map);
  add_target_options(command, options->target);
  command.add_flag(
      "--no-check", options->no_check,
      "build even if the program has errors; a structured program with errors cannot be built");
  const auto listing =
      command.add_flag("--listing", options->listing,
                       "instead of the bytes: each line and the instructions that "
                       "the virtual ball turns it into; for a structured program, the "
                       "robot's lines and their bytes");
  listing.excludes(readable);
  command.add_flag("--native", options->native, "with --listing, also show the machine code")
      .needs(listing);
  command.callback([&context, options] { build(context, *options); });
}

} // namespace orb::cli
