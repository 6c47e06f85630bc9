#include "testing/check_files.h"

#include "base/fixes.h"
#include "compiler/check.h"
#include "report/course.h"
#include "structured/compile.h"
#include "testing/suite.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace orb::testing {
namespace {

using run::Language;
using run::SourceFile;

/// What the files of one call share.
struct Call {
  std::span<const SourceFile> sources;
  const compiler::Target& target;
  structured::Files& reader;
  std::vector<FileFindings> macros; ///< of the macro sources, in order
  std::size_t next_macro = 0;
  Findings found;
};

void check_course(const SourceFile& file, Call& call) {
  call.found.files.push_back({&file.source, report::read_course(file.source).findings, {}});
}

void check_tests(const SourceFile& file, Call& call) {
  call.found.files.push_back({&file.source, check(file.source, call.reader), {}});
}

void check_basic(const SourceFile& file, Call& call) {
  auto checked = compiler::check(file.source.text(), call.target);
  call.found.files.push_back({&file.source, std::move(checked.diagnostics), checked.image_bytes});
}

void check_macro(const SourceFile&, Call& call) {
  call.found.files.push_back(std::move(call.macros[call.next_macro++]));
}

/// Whether an included file is checked for its own sake, or was shown already.
bool is_told(const Call& call, const std::string& name) {
  const auto& files = call.found.files;
  return std::any_of(call.sources.begin(), call.sources.end(),
                     [&](const SourceFile& source) { return source.source.name() == name; }) ||
         std::any_of(files.begin(), files.end(),
                     [&](const FileFindings& other) { return other.source->name() == name; });
}

/// A structured program, and after it each included file that something is said about.
void check_structured(const SourceFile& file, Call& call) {
  const auto& source = file.source;
  const auto compiled =
      structured::compile(source.name(), source.name(), source.text(), call.target, call.reader);
  const auto& program = compiled.program;
  auto found = structured::findings_by_file(program);
  std::optional<std::size_t> built_size;
  if (!compiled.robot.lines.empty())
    built_size = compiled.image_bytes;
  call.found.files.push_back({&source, std::move(found.front()), built_size});
  for (std::size_t i = 1; i < found.size(); ++i) {
    const auto& part = program.files[i];
    if (found[i].empty() || is_told(call, part.name))
      continue;
    call.found.included.emplace_back(part.name,
                                     program.text.substr(part.begin, part.end - part.begin));
    call.found.files.push_back({&call.found.included.back(), std::move(found[i]), {}});
  }
}

/// A kind of file, and what checks one.
struct FileKind {
  bool (*is_of_kind)(const SourceFile& file);
  void (*check)(const SourceFile& file, Call& call);
};

/// The first kind that takes a file checks it: what a name says is stronger than a language.
constexpr std::array<FileKind, 5> kinds = {{
    {[](const SourceFile& file) { return report::is_course(file.path); }, check_course},
    {[](const SourceFile& file) { return is_test(file.path); }, check_tests},
    {[](const SourceFile& file) { return file.language == Language::Basic; }, check_basic},
    {[](const SourceFile& file) { return file.language == Language::Structured; },
     check_structured},
    {[](const SourceFile& file) { return file.language == Language::Macro; }, check_macro},
}};

const FileKind& kind_of(const SourceFile& file) {
  return *std::find_if(kinds.begin(), kinds.end(),
                       [&](const FileKind& kind) { return kind.is_of_kind(file); });
}

} // namespace

bool is_no_program(std::string_view file_name) {
  return report::is_course(file_name) || is_test(file_name);
}

Findings check_files(std::span<const SourceFile> sources, const compiler::Target& target,
                     const assembler::LintOptions& macro, structured::Files& files) {
  std::vector<const Source*> macros;
  for (const auto& file : sources)
    if (kind_of(file).check == check_macro)
      macros.push_back(&file.source);
  Call call{sources, target, files, assembler::check(macros, macro), 0, {}};
  for (const auto& file : sources)
    kind_of(file).check(file, call);
  return std::move(call.found);
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
