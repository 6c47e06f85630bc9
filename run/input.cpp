#include "run/input.h"

#include "assembler/assemble.h"
#include "assembler/lint.h"
#include "compiler/check.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace orb::run {
namespace {

struct Ending {
  std::string_view text;
  Form form;
};

constexpr auto endings = std::to_array<Ending>({
    {".bas", Form::Basic},
    {".orbbas", Form::Basic},
    {".macro", Form::MacroSource},
    {".sphero", Form::MacroBody},
    {".bin", Form::MacroImage},
});

bool is_built(std::string_view text) {
  return text.ends_with('\0');
}

/// The name of a file without folders and ending.
std::string stem(std::string_view name) {
  name = name.substr(name.rfind('/') + 1);
  const auto dot = name.rfind('.');
  return std::string(dot == 0 ? name : name.substr(0, dot));
}

void read_program(Input& input, const compiler::Target& target, Findings findings) {
  auto checked = compiler::check(input.source->text(), target);
  // A file that is not a program at all (empty, binary, huge) is of no use, linted or not.
  if (findings == Findings::Lint || !checked.image_bytes)
    input.findings = std::move(checked.diagnostics);
  auto image = compiler::build_image(checked.program, compiler::Packing::Plain);
  if (is_built(input.source->text()))
    image.bytes = input.source->text();
  input.program = Program{std::move(checked.program), std::move(image)};
}

void read_macro_source(Input& input, Findings findings) {
  auto assembly = assembler::assemble(*input.source);
  for (const auto& macro : assembly.macros) {
    Macro read{macro.name.empty() ? stem(input.source->name()) : macro.name,
               macro.image(),
               macro.id.has_value(),
               {}};
    for (const auto& command : macro.commands)
      read.command_lines.push_back(input.source->position(command.span.begin).line);
    input.macros.push_back(std::move(read));
  }
  input.findings = findings == Findings::Lint ? assembler::check(*input.source)
                                              : std::move(assembly.diagnostics);
}

tl::expected<void, Failure> read_macro_bytes(Input& input, Form form) {
  const auto wrong = [&](const protocol::MacroError& error) {
    return tl::unexpected(Failure{ExitCode::BadInput, fmt::format("{}: {}", input.source->name(),
                                                                  protocol::to_string(error))});
  };
  const auto bytes = as_bytes(input.source->text());
  Macro macro{stem(input.source->name()), {}, form == Form::MacroImage, {}};
  if (form == Form::MacroImage) {
    auto image = protocol::decode_macro(bytes);
    if (!image)
      return wrong(image.error());
    macro.image = *std::move(image);
  } else {
    macro.image.id = spec::macro_id_temporary;
    macro.image.flags = spec::macro_default_flags;
    macro.image.body.assign(bytes.begin(), bytes.end());
  }
  if (const auto listing = protocol::decode_macro_body(macro.image.body); listing.error)
    return wrong(*listing.error);
  input.macros.push_back(std::move(macro));
  return {};
}

} // namespace

std::optional<Form> form_of(std::string_view name, std::string_view language) {
  const auto ending = std::find_if(endings.begin(), endings.end(),
                                   [&](const Ending& row) { return name.ends_with(row.text); });
  const bool macro_bytes = ending != endings.end() &&
                           (ending->form == Form::MacroBody || ending->form == Form::MacroImage);
  if (language == "basic")
    return Form::Basic;
  if (language == "macro" && !macro_bytes)
    return Form::MacroSource;
  return ending == endings.end() ? std::nullopt : std::optional(ending->form);
}

std::optional<Language> language_of(std::string_view name, std::string_view language) {
  const auto form = form_of(name, language);
  if (form == Form::Basic)
    return Language::Basic;
  if (form == Form::MacroSource)
    return Language::Macro;
  return std::nullopt;
}

Failure unknown_form(std::string_view name) {
  return {ExitCode::Usage, fmt::format("cannot tell the language of {} by its name; give "
                                       "`--lang basic` or `--lang macro`",
                                       name)};
}

std::optional<std::uint16_t> Program::first_line() const {
  for (const auto& line : parsed.lines)
    if (line.has_number() && line.has_statement() && line.number <= UINT16_MAX)
      return static_cast<std::uint16_t>(line.number);
  return std::nullopt;
}

bool Input::has_errors() const {
  return std::any_of(findings.begin(), findings.end(), [](const Diagnostic& diagnostic) {
    return diagnostic.severity == Severity::Error;
  });
}

tl::expected<Input, Failure> read_input(std::string name, std::string text,
                                        std::string_view language, const compiler::Target& target,
                                        Findings findings) {
  const auto form = form_of(name, language);
  if (!form && !is_built(text))
    return tl::unexpected(unknown_form(name));
  Input input;
  input.source = std::make_unique<Source>(std::move(name), std::move(text));
  switch (form.value_or(Form::Basic)) {
  case Form::Basic: read_program(input, target, findings); break;
  case Form::MacroSource: read_macro_source(input, findings); break;
  case Form::MacroBody:
  case Form::MacroImage:
    if (auto read = read_macro_bytes(input, *form); !read)
      return tl::unexpected(read.error());
    break;
  }
  return input;
}

} // namespace orb::run
