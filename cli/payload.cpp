#include "cli/payload.h"

#include "assembler/assemble.h"
#include "assembler/lint.h"
#include "base/render.h"
#include "compiler/check.h"
#include "disk/disk.h"

#include <filesystem>
#include <fmt/format.h>

namespace orb::cli {
namespace {

enum class FileKind : std::uint8_t { Basic, MacroSource, MacroBody, MacroImage };

tl::expected<FileKind, PayloadFailure> kind_of(const std::string& path, std::string_view lang) {
  if (lang == "basic")
    return FileKind::Basic;
  if (lang == "macro")
    return FileKind::MacroSource;
  const auto ending = std::filesystem::path(path).extension();
  if (ending == ".bas" || ending == ".orbbas")
    return FileKind::Basic;
  if (ending == ".macro")
    return FileKind::MacroSource;
  if (ending == ".sphero")
    return FileKind::MacroBody;
  if (ending == ".bin")
    return FileKind::MacroImage;
  return tl::unexpected(PayloadFailure{
      ExitCode::Usage,
      fmt::format("{}: what this is cannot be told from its name; add `--lang basic` or "
                  "`--lang macro`",
                  disk::display_name(path))});
}

void read_basic(Payload& payload, const compiler::Target& target, Findings findings) {
  auto checked = compiler::check(payload.source->text(), target);
  // What is no program at all (empty, binary, huge) cannot be sent, linted or not.
  if (findings == Findings::Lint || !checked.image_bytes)
    payload.diagnostics = std::move(checked.diagnostics);
  payload.program = compiler::build_image(checked.program, compiler::Packing::Plain);
}

void read_macro_source(Payload& payload, Findings findings) {
  auto assembly = assembler::assemble(*payload.source);
  payload.diagnostics = assembly.diagnostics;
  if (findings == Findings::Lint)
    payload.diagnostics = assembler::check(*payload.source);
  const auto stem = std::filesystem::path(payload.source->name()).stem().string();
  for (const auto& macro : assembly.macros)
    payload.macros.push_back(
        {macro.name.empty() ? stem : macro.name, macro.image(), macro.id.has_value()});
}

/// The commands of a `.sphero` file, which names neither id nor flags.
tl::expected<void, PayloadFailure> read_macro_bytes(Payload& payload, FileKind kind) {
  const auto bytes = as_bytes(payload.source->text());
  MacroPayload macro;
  macro.name = std::filesystem::path(payload.source->name()).stem().string();
  if (kind == FileKind::MacroBody) {
    macro.image.id = spec::macro_id_temporary;
    macro.image.flags = spec::macro_default_flags;
    macro.image.body.assign(bytes.begin(), bytes.end());
  } else {
    auto image = protocol::decode_macro(bytes);
    if (!image)
      return tl::unexpected(
          PayloadFailure{ExitCode::BadInput, fmt::format("{}: {}", payload.source->name(),
                                                         protocol::to_string(image.error()))});
    macro.image = *std::move(image);
    macro.has_id = true;
  }
  const auto listing = protocol::decode_macro_body(macro.image.body);
  if (listing.error)
    return tl::unexpected(
        PayloadFailure{ExitCode::BadInput, fmt::format("{}: {}", payload.source->name(),
                                                       protocol::to_string(*listing.error))});
  payload.macros.push_back(std::move(macro));
  return {};
}

} // namespace

tl::expected<Payload, PayloadFailure> load_payload(const std::string& path, std::string_view lang,
                                                   const compiler::Target& target,
                                                   Findings findings) {
  const auto kind = kind_of(path, lang);
  if (!kind)
    return tl::unexpected(kind.error());
  auto text = disk::read(path);
  if (!text)
    return tl::unexpected(PayloadFailure{ExitCode::File, text.error().message});
  Payload payload;
  payload.source = std::make_unique<Source>(disk::display_name(path), std::move(*text));
  switch (*kind) {
  case FileKind::Basic: read_basic(payload, target, findings); break;
  case FileKind::MacroSource: read_macro_source(payload, findings); break;
  case FileKind::MacroBody:
  case FileKind::MacroImage:
    if (auto read = read_macro_bytes(payload, *kind); !read)
      return tl::unexpected(read.error());
    break;
  }
  return payload;
}

bool print_findings(const Context& context, const Payload& payload) {
  auto errors = false;
  for (const auto& diagnostic : payload.diagnostics) {
    const auto is_error = diagnostic.severity == Severity::Error;
    errors = errors || is_error;
    if (is_error || (!context.quiet && diagnostic.severity == Severity::Warning) ||
        context.verbosity > 0)
      print_err(render_text(*payload.source, diagnostic, context.err_style()));
  }
  return errors;
}

} // namespace orb::cli
