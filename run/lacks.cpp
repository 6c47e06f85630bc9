#include "run/lacks.h"

#include "assembler/lint/lint.h"
#include "assembler/text/rules.h"
#include "compiler/text/rules.h"
#include "run/texts.h"

#include <fmt/format.h>
#include <utility>

namespace orb::run {
namespace {

/// The files of a program as they were at compile time.
class CompiledFiles final : public structured::Files {
public:
  explicit CompiledFiles(const structured::Program& program) : program_(program) {}

  std::optional<std::string> read(const std::string& path) override {
    for (const auto& file : program_.files)
      if (file.path == path)
        return program_.text.substr(file.begin, file.end - file.begin);
    for (const auto& file : program_.macro_files)
      if (file.path == path)
        return file.text;
    return std::nullopt;
  }

private:
  const structured::Program& program_;
};

/// Returns true if the finding depends on a version.
bool is_of_age(const Diagnostic& found) {
  const auto is = [&](const Rule& rule) { return found.rule == &rule; };
  return is_error(found) &&
         (is(compiler::rules::NewerThanTarget) || is(compiler::rules::NegativeLiteral) ||
          is(assembler::rules::Executive));
}

class Lacks {
public:
  void add(const Source& source, const std::vector<Diagnostic>& findings) {
    for (const auto& one : findings)
      if (is_of_age(one))
        all_.push_back({&source, source.name(), one});
  }

  /// Adds what a macro without source lacks.
  void add(const Macro& macro, int executive) {
    const auto listing = protocol::decode_macro_body(macro.image.body);
    for (std::size_t n = 0; n < listing.steps.size(); ++n) {
      const auto& row = *listing.steps[n].info;
      if (row.executive <= executive)
        continue;
      Diagnostic finding;
      finding.rule = &assembler::rules::Executive;
      finding.message = texts::CommandNeedsExecutive(row.mnemonic, n + 1, row.executive, executive);
      all_.push_back({nullptr, macro.name, std::move(finding)});
    }
  }

  std::vector<Lack> take() { return std::move(all_); }

private:
  std::vector<Lack> all_;
};

void add_structured(Lacks& lacks, const Input& input, const compiler::Target& target) {
  CompiledFiles files(input.program->compiled->program);
  const auto& name = input.source->name();
  const auto compiled = structured::compile(name, name, input.source->text(), target, files);
  const auto found = structured::findings_by_file(compiled.program);
  for (std::size_t i = 0; i < found.size() && i <= input.included.size(); ++i)
    lacks.add(i == 0 ? *input.source : *input.included[i - 1], found[i]);
}

} // namespace

std::vector<Lack> lacks_of(std::span<const Input> inputs, const uploader::Capabilities& ball) {
  Lacks lacks;
  compiler::Target target;
  target.version = ball.language;
  const int executive = ball.macro_executive;
  for (const auto& input : inputs) {
    if (input.program && !ball.has_basic)
      continue; // the plan reports that
    if (input.program && input.program->compiled)
      add_structured(lacks, input, target);
    else if (input.program)
      lacks.add(*input.source, compiler::lint(input.program->parsed, target));
    if (input.macros.empty() || executive == 0) // 0: the ball has not reported its version
      continue;
    if (!input.macros.front().command_lines.empty())
      lacks.add(*input.source, assembler::check(*input.source, {.executive = executive}));
    else
      for (const auto& macro : input.macros)
        lacks.add(macro, executive);
  }
  return lacks.take();
}

std::string in_words(std::span<const Lack> lacks, const uploader::Greeting& greeting) {
  const auto& [source, name, finding] = lacks.front();
  auto place = name;
  if (source != nullptr) {
    const auto at = source->position(finding.span.begin);
    place += fmt::format(":{}:{}", at.line, at.column);
  }
  const auto more =
      lacks.size() > 1 ? fmt::format(" (and {} more)", lacks.size() - 1) : std::string();
  return fmt::format("nothing was sent: {}: {}{}; the ball has {}", place,
                     in_english(finding.message), more, describe_firmware(greeting));
}

} // namespace orb::run
