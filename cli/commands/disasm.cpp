#include "assembler/disassemble.h"
#include "base/bytes.h"
#include "cli/commands/commands.h"
#include "disk/disk.h"

#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <optional>

namespace orb::cli {
namespace {

using assembler::Reading;

struct DisasmOptions {
  std::string file;
  std::string out;
  bool raw = false;
  bool framed = false;
};

/// Decides what the bytes are: from the option, from the file extension, or because only one
/// reading works. Nothing if both work.
std::optional<Reading> choose(const DisasmOptions& options, const std::string& ending,
                              ByteView bytes) {
  if (options.raw || options.framed)
    return options.raw ? Reading::Headerless : Reading::Framed;
  if (ending == ".sphero")
    return Reading::Headerless;
  if (ending == ".bin" || ending == ".hex")
    return Reading::Framed;
  const bool headerless = assembler::is_whole(bytes, Reading::Headerless);
  const bool framed = assembler::is_whole(bytes, Reading::Framed);
  if (headerless && framed)
    return std::nullopt;
  return framed ? Reading::Framed : Reading::Headerless;
}

ExitCode disassemble_file(const Context& context, const DisasmOptions& options) {
  auto content = disk::read(options.file);
  if (!content) {
    print_error(context, content.error().message);
    return ExitCode::File;
  }
  const auto name = disk::display_name(options.file);
  const auto ending = disk::as_path(options.file).extension().string();
  Bytes bytes{content->begin(), content->end()};
  if (ending == ".hex") {
    auto read = from_hex(*content);
    if (!read) {
      print_error(context, fmt::format("{}: this is not hex; expected pairs of hex digits", name));
      return ExitCode::BadInput;
    }
    bytes = std::move(*read);
  }
  if (bytes.empty()) {
    print_error(context, fmt::format("{}: the file is empty; expected a macro command", name));
    return ExitCode::BadInput;
  }
  const auto reading = choose(options, ending, bytes);
  if (!reading) {
    print_error(context,
                fmt::format("{} can be read in two ways: commands alone (`--raw`), or with "
                            "id and flags before them (`--framed`); say which",
                            name));
    return ExitCode::Usage;
  }
  const auto text = assembler::disassemble(bytes, *reading);
  if (!text) {
    print_error(context, fmt::format("{}: {}", name, text.error()));
    return ExitCode::BadInput;
  }
  if (options.out.empty() || options.out == "-") {
    print_out(*text);
    return ExitCode::Done;
  }
  if (const auto written = disk::write(options.out, as_bytes(*text)); !written) {
    print_error(context, written.error().message);
    return ExitCode::File;
  }
  return ExitCode::Done;
}

} // namespace

void add_disasm(const Command& orb, Context& context) {
  const auto command =
      orb.add_command("disasm", "turn the bytes of a macro back into source",
                      "orb disasm dance.sphero\norb disasm saved.bin -o saved.macro\n"
                      "orb disasm capture.dat --framed");
  auto options = std::make_shared<DisasmOptions>();
  command.add_option("FILE", options->file, "bytes of a macro; - is stdin").required();
  command.add_option("-o,--out", options->out, "where to write the source; stdout by default");
  const auto raw = command.add_flag("--raw", options->raw, "the bytes are commands only (.sphero)");
  command.add_flag("--framed", options->framed, "the bytes begin with id and flags (.bin)")
      .excludes(raw);
  command.callback([&context, options] { context.exit = disassemble_file(context, *options); });
}

} // namespace orb::cli
