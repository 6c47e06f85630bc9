#include "cli/run_inputs.h"

#include "assembler/assemble.h"
#include "base/render.h"
#include "compiler/image.h"
#include "compiler/parse.h"
#include "disk/disk.h"
#include "spec/limits.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <iterator>

namespace orb::cli {

tl::unexpected<Refusal> refuse(ExitCode code, std::string message) {
  return tl::unexpected(Refusal{code, std::move(message)});
}

std::optional<Duration> read_duration(std::string_view text) {
  double value = 0;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  const std::string_view unit = text.substr(static_cast<std::size_t>(end - text.data()));
  constexpr double longest = 1e6; // hours
  if (error != std::errc{} || value < 0)
    return std::nullopt;
  const double seconds = unit == "ms"                  ? value / 1000
                         : unit == "s" || unit.empty() ? value
                         : unit == "min"               ? value * 60
                         : unit == "h"                 ? value * 3600
                                                       : -1;
  if (seconds < 0 || seconds > longest * 3600)
    return std::nullopt;
  return Duration{static_cast<Duration::rep>(seconds * 1e9 + 0.5)};
}

namespace {

bool is_macro(const std::string& path) {
  return path.ends_with(".macro") || path.ends_with(".sphero") || path.ends_with(".bin");
}

RunResult<std::unique_ptr<ProgramFile>> read_program(const std::string& path) {
  auto text = disk::read(path);
  if (!text)
    return refuse(ExitCode::File, text.error().message);
  const auto name = disk::display_name(path);
  constexpr auto most = static_cast<std::size_t>(spec::value_of(spec::Limit::SourceBytes));
  if (text->size() > most)
    return refuse(ExitCode::BadInput,
                  fmt::format("{} has {} bytes; no program area is larger than {}", name,
                              text->size(), spec::value_of(spec::Limit::FlashBytes)));
  const bool built = text->ends_with('\0');
  if (built)
    text->pop_back();
  if (text->find('\0') != std::string::npos)
    return refuse(ExitCode::BadInput,
                  fmt::format("{} is a binary file, not an orbBasic program", name));
  auto file = std::make_unique<ProgramFile>(ProgramFile{Source(name, std::move(*text)), {}, {}, 0});
  file->program = compiler::parse(file->source.text());
  const auto first =
      std::find_if(file->program.lines.begin(), file->program.lines.end(),
                   [](const auto& line) { return line.has_number() && line.has_statement(); });
  if (first == file->program.lines.end())
    return refuse(ExitCode::BadInput, fmt::format("{} holds no program: no line begins with a line "
                                                  "number and a statement",
                                                  name));
  file->first_line = static_cast<std::uint16_t>(std::min<std::uint32_t>(first->number, 0xFFFF));
  if (built) {
    const auto bytes = as_bytes(file->source.text());
    file->image.assign(bytes.begin(), bytes.end());
    file->image.push_back(0);
  } else {
    const auto image = compiler::build_image(file->program, compiler::Packing::Plain);
    const auto bytes = as_bytes(image.bytes);
    file->image.assign(bytes.begin(), bytes.end());
  }
  return file;
}

/// Every macro of a source file, in order.
RunResult<std::vector<MacroFile>> assemble_macros(const Source& source, const Context& context) {
  const auto assembly = assembler::assemble(source);
  if (assembly.has_errors()) {
    for (const auto& diagnostic : assembly.diagnostics)
      if (diagnostic.severity == Severity::Error)
        print_err(render_text(source, diagnostic, context.err_style()));
    return refuse(ExitCode::BadInput, fmt::format("{} has mistakes", source.name()));
  }
  std::vector<MacroFile> files;
  for (const auto& macro : assembly.macros) {
    MacroFile file{source.name(), macro.image(), std::string(source.text()), {}};
    for (const auto& command : macro.commands)
      file.command_lines.push_back(static_cast<int>(source.position(command.span.begin).line));
    files.push_back(std::move(file));
  }
  if (files.empty())
    return refuse(ExitCode::BadInput, fmt::format("{} holds no macro", source.name()));
  return files;
}

RunResult<std::vector<MacroFile>> read_macros(const std::string& path, const Context& context) {
  const auto text = disk::read(path);
  if (!text)
    return refuse(ExitCode::File, text.error().message);
  if (!path.ends_with(".sphero") && !path.ends_with(".bin"))
    return assemble_macros(Source(disk::display_name(path), *text), context);
  MacroFile file{disk::display_name(path), {}, {}, {}};
  const auto bytes = as_bytes(*text);
  if (path.ends_with(".bin")) {
    const auto image = protocol::decode_macro(bytes);
    if (!image)
      return refuse(ExitCode::BadInput,
                    fmt::format("{}: {}", file.name, protocol::to_string(image.error())));
    file.image = *image;
  } else {
    file.image.flags = static_cast<std::uint8_t>(spec::MacroFlag::MotorControl);
    file.image.body.assign(bytes.begin(), bytes.end());
  }
  const auto listing = protocol::decode_macro_body(file.image.body);
  if (listing.error)
    return refuse(ExitCode::BadInput,
                  fmt::format("{}: {}", file.name, protocol::to_string(*listing.error)));
  std::vector<MacroFile> files;
  files.push_back(std::move(file));
  return files;
}

} // namespace

RunResult<RunInputs> read_run_inputs(const std::vector<std::string>& files,
                                     std::string_view language, const std::string& stimulus,
                                     const Context& context) {
  RunInputs inputs;
  for (const auto& path : files) {
    const bool macro = language.empty() ? is_macro(path) : language == "macro";
    if (macro) {
      auto macros = read_macros(path, context);
      if (!macros)
        return tl::unexpected(macros.error());
      std::move(macros->begin(), macros->end(), std::back_inserter(inputs.macros));
    } else {
      auto file = read_program(path);
      if (!file)
        return tl::unexpected(file.error());
      inputs.programs.push_back(std::move(*file));
    }
  }
  if (inputs.programs.size() > 2)
    return refuse(ExitCode::Usage, "a ball holds two programs: one in RAM, one in flash");
  if (!stimulus.empty()) {
    auto text = disk::read(stimulus);
    if (!text)
      return refuse(ExitCode::File, text.error().message);
    const Source source(disk::display_name(stimulus), std::move(*text));
    auto script = vm::parse_stimulus(source);
    for (const auto& diagnostic : script.diagnostics)
      print_err(render_text(source, diagnostic, context.err_style()));
    if (!script.diagnostics.empty())
      return refuse(ExitCode::BadInput, "the stimulus script has mistakes");
    inputs.stimuli = std::move(script.events);
  }
  return inputs;
}

} // namespace orb::cli
