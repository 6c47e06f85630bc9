#include "run/input.h"

#include "assembler/assemble.h"
#include "assembler/disassemble.h"
#include "assembler/lint/lint.h"
#include "base/text/text.h"
#include "base/text/utf8.h"
#include "compiler/check.h"
#include "report/course.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <utility>

namespace orb::run {
namespace {

struct FileEnding {
  std::string_view text;
  Content content;
};

constexpr auto endings = std::to_array<FileEnding>({
    {".bas", Content::Basic},
    {".orbbas", Content::Basic},
    {".orb", Content::Structured},
    {".macro", Content::MacroSource},
    {".sphero", Content::MacroBody},
    {".bin", Content::MacroImage},
});

bool is_built(std::string_view text) {
  return text.ends_with('\0');
}

void read_program(Input& input) {
  auto read = compiler::read(input.source->text());
  auto image = compiler::build_image(read.program, compiler::Packing::Plain);
  if (is_built(input.source->text()))
    image.bytes = input.source->text();
  auto lines = line_map(input.source->name(), image);
  input.errors.push_back({input.source.get(), std::move(read.diagnostics), {}});
  input.program = Program{std::move(read.program), std::move(image), std::move(lines), nullptr};
}

void read_macro_source(Input& input) {
  auto assembly = assembler::assemble(*input.source);
  for (const auto& macro : assembly.macros) {
    Macro read{macro.name.empty() ? std::string(stem(input.source->name())) : macro.name,
               macro.image(),
               macro.id.has_value(),
               {}};
    for (const auto& command : macro.commands)
      read.command_lines.push_back(command.origin == assembler::PlacedCommand::Origin::Supplied
                                       ? 0
                                       : input.source->position(command.span.begin).line);
    input.macros.push_back(std::move(read));
  }
  input.errors.push_back({input.source.get(), std::move(assembly.diagnostics), {}});
}

/// Reads the macros of a file that a program uses. Only macros with an id can be called.
Input used_macros(const structured::MacroFile& file) {
  Input used;
  used.source = std::make_unique<Source>(file.path, file.text);
  read_macro_source(used);
  used.checked->files = used.errors; // only errors are reported for files the user did not name
  std::erase_if(used.macros, [](const Macro& macro) { return !macro.has_id; });
  return used;
}

void read_structured(Input& input, structured::Files& files, const std::vector<std::string>& kept,
                     structured::Shape shape) {
  const auto& name = input.source->name();
  const auto compile = [&](structured::Shape one) {
    return std::make_unique<structured::Compiled>(
        structured::compile(name, name, input.source->text(), input.target, files, kept, one));
  };
  auto compiled = compile(shape);
  if (shape == structured::Shape::Steppable && compiled->has_errors())
    compiled = compile(structured::Shape::Shortest);
  auto found = structured::findings_by_file(compiled->program);
  if (!compiled->has_errors() && !compiled->runs) // valid, but there is nothing to run or send
    found.front().push_back(structured::nothing_to_run());
  auto& all = input.checked->files; // the compiler has already checked it
  all.push_back({input.source.get(), std::move(found.front()), {}});
  for (std::size_t i = 1; i < found.size(); ++i) {
    const auto& file = compiled->program.files[i];
    auto text = compiled->program.text.substr(file.begin, file.end - file.begin);
    input.included.push_back(std::make_unique<Source>(file.name, std::move(text)));
    all.push_back({input.included.back().get(), std::move(found[i]), {}});
  }
  input.errors = all;
  for (auto& file : input.errors)
    std::erase_if(file.diagnostics,
                  [](const Diagnostic& one) { return !keeps_from_building(one); });
  if (compiled->has_errors() || !compiled->runs)
    return;
  for (const auto& file : compiled->program.macro_files)
    input.used.push_back(used_macros(file));
  auto parsed = structured::take_lines(*compiled);
  auto image = std::move(compiled->image);
  auto lines = line_map(*compiled);
  input.program =
      Program{std::move(parsed), std::move(image), std::move(lines), std::move(compiled)};
}

tl::expected<void, Failure> read_macro_bytes(Input& input, Content content) {
  const auto wrong = [&](const protocol::MacroError& error) {
    return tl::unexpected(Failure{ExitCode::BadInput, fmt::format("{}: {}", input.source->name(),
                                                                  protocol::to_string(error))});
  };
  const auto bytes = as_bytes(input.source->text());
  Macro macro{std::string(stem(input.source->name())), {}, content == Content::MacroImage, {}};
  if (content == Content::MacroImage) {
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
  input.checked->files.push_back({input.source.get(), {}, {}}); // there is no source to check
  return {};
}

} // namespace

std::optional<Content> content_of(std::string_view name, std::string_view language) {
  const auto ending = std::find_if(endings.begin(), endings.end(), [&](const FileEnding& row) {
    return has_ending(name, row.text);
  });
  const bool macro_bytes = ending != endings.end() && (ending->content == Content::MacroBody ||
                                                       ending->content == Content::MacroImage);
  if (language == "basic")
    return Content::Basic;
  if (language == "structured")
    return Content::Structured;
  if (language == "macro" && !macro_bytes)
    return Content::MacroSource;
  return ending == endings.end() ? std::nullopt : std::optional(ending->content);
}

std::optional<Language> language_of(std::string_view name, std::string_view language) {
  const auto content = content_of(name, language);
  if (content == Content::Basic)
    return Language::Basic;
  if (content == Content::Structured)
    return Language::Structured;
  if (content == Content::MacroSource)
    return Language::Macro;
  return std::nullopt;
}

std::string_view language_of_text(std::string_view text) {
  text.remove_prefix(byte_order_mark_size(text));
  while (!text.empty()) {
    const auto line = trim(text.substr(0, text.find('\n')));
    text.remove_prefix(
        std::min(text.size(), text.find('\n') == text.npos ? text.npos : text.find('\n') + 1));
    if (line.empty() || line[0] == '#' || line[0] == '\'')
      continue;
    return is_digit(line[0]) ? "basic" : line[0] == '.' ? "macro" : "structured";
  }
  return "structured";
}

bool holds_macro_bytes(std::string_view name) {
  const auto content = content_of(name, {});
  return content == Content::MacroBody || content == Content::MacroImage;
}

tl::expected<std::string, Failure> macro_source(std::string_view name, std::string_view bytes) {
  if (bytes.empty())
    return tl::unexpected(Failure{
        ExitCode::BadInput, fmt::format("{}: the file is empty; expected a macro command", name)});
  auto text = assembler::disassemble(as_bytes(bytes), content_of(name, {}) == Content::MacroImage
                                                          ? assembler::Reading::Framed
                                                          : assembler::Reading::Headerless);
  if (!text)
    return tl::unexpected(Failure{ExitCode::BadInput, fmt::format("{}: {}", name, text.error())});
  return *std::move(text);
}

Failure not_text(std::string_view name) {
  return {ExitCode::Usage,
          fmt::format("{0} holds bytes, not text; `orb disasm {0} -o {1}.macro` makes a source of "
                      "it",
                      name, stem(name))};
}

Failure unknown_content(std::string_view name) {
  if (report::is_course(name))
    return {ExitCode::Usage,
            fmt::format("{0} is a course; `orb run PROGRAM --course {0}` drives through it", name)};
  if (has_ending(name, ".test"))
    return {ExitCode::Usage, fmt::format("{0} is a test; run it with `orb test {0}`", name)};
  if (has_ending(name, ".toml"))
    return {
        ExitCode::Usage,
        fmt::format("{0} is a room; `orb run {0}` runs it, `orb check {0}` checks it, and other "
                    "commands take its programs one by one",
                    name)};
  if (has_ending(name, ".stimulus"))
    return {
        ExitCode::Usage,
        fmt::format("{0} is a stimulus script; `orb run PROGRAM --stimulus {0}` plays it", name)};
  if (has_ending(name, ".js"))
    return {ExitCode::Usage,
            fmt::format("{0} is JavaScript; `npx orb-robot check {0}` checks a program of Sphero "
                        "Edu, and `npx orb-robot run {0}` runs it on a virtual robot",
                        name)};
  return {ExitCode::Usage, fmt::format("cannot tell the language of {} from its name; give "
                                       "`--lang basic`, `--lang structured` or `--lang macro`",
                                       name)};
}

std::optional<std::uint16_t> Program::first_line() const {
  for (const auto& line : parsed.lines)
    if (line.has_number() && line.has_statement() && line.number <= UINT16_MAX)
      return static_cast<std::uint16_t>(line.number);
  return std::nullopt;
}

std::string Program::where(std::uint32_t robot_line) const {
  const auto place = compiled ? lines.words(robot_line) : std::string();
  return place.empty() ? fmt::format("line {}", robot_line) : place;
}

bool Input::has_errors() const {
  return std::any_of(errors.begin(), errors.end(),
                     [](const FileFindings& file) { return any_error(file.diagnostics); });
}

tl::expected<Input, Failure> read_input(std::string name, std::string text,
                                        std::string_view language, const compiler::Target& target,
                                        structured::Files& files,
                                        const std::vector<std::string>& kept,
                                        structured::Shape shape) {
  const auto content = content_of(name, language);
  if (!content && !is_built(text))
    return tl::unexpected(unknown_content(name));
  Input input;
  input.source = std::make_unique<Source>(std::move(name), std::move(text));
  input.target = target;
  switch (content.value_or(Content::Basic)) {
  case Content::Basic: read_program(input); break;
  case Content::Structured: read_structured(input, files, kept, shape); break;
  case Content::MacroSource: read_macro_source(input); break;
  case Content::MacroBody:
  case Content::MacroImage:
    if (auto read = read_macro_bytes(input, *content); !read)
      return tl::unexpected(read.error());
    break;
  }
  return input;
}

const std::vector<FileFindings>& findings(const Input& input) {
  auto& checked = *input.checked;
  std::call_once(checked.once, [&] {
    if (!checked.files.empty())
      return;
    checked.files = input.errors;
    auto& found = checked.files.front().diagnostics;
    if (!input.program)
      found = assembler::check(*input.source);
    else if (found.empty()) // it is a program
      found = compiler::check(input.program->parsed, input.target);
  });
  return checked.files;
}

const Input* first_with_program(std::span<const Input> inputs) {
  const auto found = std::find_if(inputs.begin(), inputs.end(),
                                  [](const Input& one) { return one.program.has_value(); });
  return found == inputs.end() ? nullptr : &*found;
}

tl::expected<void, Failure> check_start_line(std::span<const Input> inputs,
                                             std::optional<std::uint16_t> line) {
  for (const auto& input : inputs)
    if (line && input.program && input.program->compiled)
      return tl::unexpected(Failure{
          ExitCode::Usage, fmt::format("{} has no line {} to start at: structured programs have no "
                                       "line numbers",
                                       input.source->name(), *line)});
  return {};
}

void add_input(std::vector<Input>& inputs, Input input) {
  const auto same = [&](const Input& one) {
    return std::find_if(inputs.begin(), inputs.end(), [&](const Input& other) {
      return other.source->name() == one.source->name() && !other.program && !one.program;
    });
  };
  for (auto& used : std::exchange(input.used, {}))
    if (same(used) == inputs.end())
      inputs.push_back(std::move(used));
  if (const auto found = same(input); found != inputs.end() && !input.macros.empty())
    *found = std::move(input); // replace it by the version that includes macros without an id
  else
    inputs.push_back(std::move(input));
}

} // namespace orb::run
