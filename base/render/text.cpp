#include "base/text/text.h"
#include "base/render.h"
#include "base/text/utf8.h"
#include "base/texts.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>

namespace orb {
namespace {

constexpr std::size_t excerpt_width = 100;

std::string_view gcc_word(Severity severity) {
  return severity == Severity::Info ? "note" : to_string(severity);
}

/// The source line of `span` with a caret line under it. Long lines are cut to a window around the
/// caret that begins at a code point.
std::string excerpt(const Source& source, Span span, Role role, Style style) {
  const auto place = source.position(span.begin);
  const auto line = source.line(place.line);
  const std::size_t column = std::min<std::size_t>(place.column - 1, line.size());
  std::size_t from = column > excerpt_width / 2 ? column - excerpt_width / 2 : 0;
  if (line.size() <= excerpt_width)
    from = 0;
  while (from > 0 && from < column && (static_cast<unsigned char>(line[from]) & 0xC0) == 0x80)
    ++from;
  const auto window = line.substr(from, excerpt_width);
  const auto before = line.substr(from, column - from);
  const auto marked = line.substr(column, std::min<std::size_t>(span.size(), line.size() - column));
  const auto room = window.size() - std::min(window.size(), before.size());
  const auto width = std::max<std::size_t>(1, code_points(marked.substr(0, room)));

  const auto number = fmt::format("{:>3}", place.line);
  const std::string caret = '^' + std::string(width - 1, '~');
  std::string out;
  fmt::format_to(std::back_inserter(out), "{} | {}{}{}\n", number, from > 0 ? "…" : "",
                 to_printable(window), from + window.size() < line.size() ? "…" : "");
  fmt::format_to(std::back_inserter(out), "{} | {}{}\n", std::string(number.size(), ' '),
                 std::string(code_points(before) + (from > 0 ? 1 : 0), ' '),
                 style.paint(role, caret));
  return out;
}

} // namespace

Message severity_word(Severity severity) {
  switch (severity) {
  case Severity::Info: return texts::Info();
  case Severity::Warning: return texts::Warning();
  case Severity::Error: return texts::Error();
  }
  return texts::Error();
}

Role role_of(Severity severity) {
  switch (severity) {
  case Severity::Info: return Role::Note;
  case Severity::Warning: return Role::Warning;
  case Severity::Error: return Role::Error;
  }
  return Role::Error;
}

std::string in_one_line(const Diagnostic& diagnostic) {
  auto line = in_english(diagnostic.message);
  return diagnostic.help.empty() ? line : line + "; " + in_english(diagnostic.help);
}

std::string render_text(const Source& source, const Diagnostic& diagnostic, Style style,
                        const Say& say) {
  const auto place = source.position(diagnostic.span.begin);
  const auto role = role_of(diagnostic.severity);
  const auto kind =
      fmt::format("{}[{}]", say(severity_word(diagnostic.severity)), diagnostic.rule->id);
  auto out = fmt::format("{}:{}:{}: {}: {}\n", shown_name(source.name()), place.line, place.column,
                         style.paint(role, kind), to_printable(say(diagnostic.message)));
  out += excerpt(source, diagnostic.span, role, style);
  if (!diagnostic.help.empty())
    out += fmt::format("  {}: {}\n", style.paint(Role::Good, say(texts::Help())),
                       to_printable(say(diagnostic.help)));
  for (const auto& note : diagnostic.notes) {
    const auto at = source.position(note.span.begin);
    out +=
        fmt::format("{}:{}:{}: {}: {}\n", shown_name(source.name()), at.line, at.column,
                    style.paint(Role::Note, say(texts::Note())), to_printable(say(note.message)));
    out += excerpt(source, note.span, Role::Note, style);
  }
  return out;
}

std::string render_gcc(const Source& source, const Diagnostic& diagnostic) {
  const auto place = source.position(diagnostic.span.begin);
  auto out = fmt::format("{}:{}:{}: {}: {} [{}]\n", shown_name(source.name()), place.line,
                         place.column, gcc_word(diagnostic.severity),
                         to_printable(in_english(diagnostic.message)), diagnostic.rule->id);
  for (const auto& note : diagnostic.notes) {
    const auto at = source.position(note.span.begin);
    out += fmt::format("{}:{}:{}: note: {}\n", shown_name(source.name()), at.line, at.column,
                       to_printable(in_english(note.message)));
  }
  return out;
}

std::string render_summary(const std::vector<FileFindings>& files, const Say& say) {
  const auto counts = count(files);
  std::string out;
  const auto add = [&](std::size_t n, const Row<>& one, const Row<Hole::Number>& several) {
    if (n > 0)
      out += fmt::format("{}{}", out.empty() ? "" : ", ", say(counted(n, one, several)));
  };
  add(counts.errors, texts::OneError, texts::Errors);
  add(counts.warnings, texts::OneWarning, texts::Warnings);
  add(counts.infos, texts::OneNote, texts::Notes);
  if (out.empty())
    out = say(texts::NoFindings());
  return fmt::format("{} {}\n", out, say(counted(files.size(), texts::InOneFile, texts::InFiles)));
}

} // namespace orb
