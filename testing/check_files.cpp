#include "testing/check_files.h"

#include "base/fixes.h"
#include "compiler/check.h"
#include "report/course.h"
#include "structured/compile.h"
#include "testing/suite.h"

#include <algorithm>
#include <utility>

namespace orb::testing {
namespace {

using run::Language;
using run::SourceFile;

std::vector<Diagnostic> check_other(const SourceFile& input, structured::Files& files) {
  return report::is_course(input.path) ? report::read_course(input.source).findings
                                       : check(input.source, files);
}

FileFindings check_basic(const Source& source, const compiler::Target& target) {
  FileFindings findings;
  findings.source = &source;
  auto checked = compiler::check(source.text(), target);
  findings.diagnostics = std::move(checked.diagnostics);
  findings.built_size = checked.image_bytes;
  return findings;
}

/// A structured program, and after it each included file that something is said about.
std::vector<FileFindings> check_structured(const Source& source, const compiler::Target& target,
                                           structured::Files& reader,
                                           std::deque<Source>& included) {
  const auto compiled =
      structured::compile(source.name(), source.name(), source.text(), target, reader);
  auto found = structured::findings_by_file(compiled.program);
  std::vector<FileFindings> files;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (i > 0 && found[i].empty())
      continue;
    const auto& file = compiled.program.files[i];
    if (i > 0)
      included.emplace_back(file.name,
                            compiled.program.text.substr(file.begin, file.end - file.begin));
    files.push_back({i == 0 ? &source : &included.back(), std::move(found[i]), {}});
  }
  if (!compiled.robot.lines.empty())
    files.front().built_size = compiled.image_bytes;
  return files;
}

/// Whether an included file is checked for its own sake, or was shown already.
bool is_told(const std::vector<FileFindings>& files, std::span<const SourceFile> inputs,
             const SourceFile& main, const FileFindings& file) {
  const auto& name = file.source->name();
  return file.source != &main.source &&
         (std::any_of(inputs.begin(), inputs.end(),
                      [&](const SourceFile& input) { return input.source.name() == name; }) ||
          std::any_of(files.begin(), files.end(),
                      [&](const FileFindings& other) { return other.source->name() == name; }));
}

} // namespace

bool is_no_program(std::string_view file_name) {
  return report::is_course(file_name) || is_test(file_name);
}

Findings check_files(std::span<const SourceFile> sources, const compiler::Target& target,
                     const assembler::LintOptions& macro, structured::Files& files) {
  std::vector<const Source*> macros;
  for (const auto& input : sources)
    if (input.language == Language::Macro && !is_no_program(input.path))
      macros.push_back(&input.source);
  auto of_macros = assembler::check(macros, macro);
  Findings found;
  std::size_t next_macro = 0;
  for (const auto& input : sources) {
    if (is_no_program(input.path)) {
      found.files.push_back({&input.source, check_other(input, files), {}});
      continue;
    }
    switch (input.language) {
    case Language::Basic: found.files.push_back(check_basic(input.source, target)); break;
    case Language::Structured:
      for (auto& file : check_structured(input.source, target, files, found.included))
        if (!is_told(found.files, sources, input, file))
          found.files.push_back(std::move(file));
      break;
    case Language::Macro: found.files.push_back(std::move(of_macros[next_macro++])); break;
    }
  }
  return found;
}

std::size_t fix(SourceFile& file,
                const std::function<std::vector<Diagnostic>(const SourceFile&)>& findings) {
  auto fixed = fix_all(std::string(file.source.text()), [&](std::string_view text) {
    auto changed = file;
    changed.source = Source(file.source.name(), std::string(text));
    return findings(changed);
  });
  file.source = Source(file.source.name(), std::move(fixed.text));
  return fixed.count;
}

} // namespace orb::testing
