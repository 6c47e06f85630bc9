#include "structured/text/program.h"

#include <algorithm>

namespace orb::structured {

Place place_of(const Program& program, Span span) {
  const auto& file = program.file_at(span.begin);
  const auto index = static_cast<std::uint32_t>(&file - program.files.data());
  const auto size = file.end - file.begin;
  const auto begin = std::min(span.begin - file.begin, size);
  return {index, {begin, std::max(begin, std::min(span.end - file.begin, size))}};
}

std::vector<std::vector<Diagnostic>> findings_by_file(const Program& program) {
  std::vector<std::vector<Diagnostic>> files(program.files.size());
  for (const auto& found : program.diagnostics) {
    auto diagnostic = found;
    const auto place = place_of(program, found.span);
    const auto shift = program.files[place.file].begin;
    diagnostic.span = place.span;
    std::erase_if(diagnostic.notes, [&](Note& note) {
      const auto there = place_of(program, note.span);
      note.span = there.span;
      return there.file != place.file; // a note must be in the file of its finding
    });
    if (diagnostic.fix)
      for (auto& edit : diagnostic.fix->edits)
        edit.span = {edit.span.begin - shift, edit.span.end - shift};
    files[place.file].push_back(std::move(diagnostic));
  }
  for (auto& findings : files)
    sort_by_place(findings);
  return files;
}

} // namespace orb::structured
