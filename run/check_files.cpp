#include "run/check_files.h"

#include "base/fixes.h"
#include "compiler/check.h"
#include "report/course.h"
#include "structured/compile.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace orb::run {
namespace {

/// State shared by the files of one call.
struct Call {
  std::span<const SourceFile> sources;
  const compiler::Target& target;
  structured::Files& reader;
  std::vector<FileFindings> macros; ///< for the macro sources, in order
  std::size_t next_macro = 0;
  Findings found;
};

void check_course(const SourceFile& file, Call& call) {
  call.found.files.push_back({&file.source, report::read_course(file.source).findings, {}});
}

void check_basic(const SourceFile& file, Call& call) {
  auto checked = compiler::check(file.source.text(), call.target);
  call.found.files.push_back({&file.source, std::move(checked.diagnostics), checked.image_bytes});
}

/// Returns true if an included file is checked in its own right or has been reported already.
bool is_told(const Call& call, const std::string& name) {
  const auto& files = call.found.files;
  return std::any_of(call.sources.begin(), call.sources.end(),
                     [&](const SourceFile& source) { return source.source.name() == name; }) ||
         std::any_of(files.begin(), files.end(),
                     [&](const FileFindings& other) { return other.source->name() == name; });
}

/// Checks a structured program, followed by each included file with findings.
void check_structured(const SourceFile& file, Call& call) {
  const auto& source = file.source;
  const auto compiled =
      structured::compile(source.name(), source.name(), source.text(), call.target, call.reader);
  const auto& program = compiled.program;
  auto found = structured::findings_by_file(program);
  std::optional<std::size_t> built_size;
  if (!compiled.robot.lines.empty())
    built_size = compiled.image.bytes.size();
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

void check_file(const SourceFile& file, Call& call) {
  if (!file.language) {
    if (report::is_course(file.path))
      check_course(file, call);
    else
      call.found.files.push_back({&file.source, {}, {}});
    return;
  }
  switch (*file.language) {
  case Language::Basic: return check_basic(file, call);
  case Language::Structured: return check_structured(file, call);
  case Language::Macro: call.found.files.push_back(std::move(call.macros[call.next_macro++]));
  }
}

} // namespace

Findings check_files(std::span<const SourceFile> sources, const compiler::Target& target,
                     const assembler::LintOptions& macro, structured::Files& files) {
  std::vector<const Source*> macros;
  for (const auto& file : sources)
    if (file.language == Language::Macro)
      macros.push_back(&file.source);
  Call call{sources, target, files, assembler::check(macros, macro), 0, {}};
  for (const auto& file : sources)
    check_file(file, call);
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

} // namespace orb::run
